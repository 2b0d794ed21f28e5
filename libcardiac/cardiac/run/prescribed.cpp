#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <cardiac/core/units.hpp>
#include <cardiac/model/pressed_wall.hpp>
#include <cardiac/run/beat_instants.hpp>
#include <cardiac/run/statics.hpp>

namespace cardiac {

using polyaffine::Vector;

namespace {

HeartState state_of(const Ventricle& ventricle, double t, const Vector& c,
                    const std::array<double, 2>& pressures_kPa) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();  // a wall without a cavity has no volume
  HeartState state{t, c, ventricle.cavity ? ventricle.cavity_volume(c) : kNone, pressures_kPa[0], 0};
  if (!ventricle.right_cavity) return state;
  state.right_volume_mm3 = ventricle.right_cavity->evaluate({c}).value;
  state.right_pressure_kPa = pressures_kPa[1];
  return state;
}

// Begin of the last contraction that ends within the duration; of the first where none does.
double last_onset(const ContractionField& contraction, double duration_ms) {
  const TensionCurve& curve = contraction.curve;
  const double first = contraction_onset_ms(contraction), period = curve.period_ms();
  const double lasts = curve.contraction_end_ms() - curve.contraction_begin_ms();
  return first + period * std::max(0.0, std::floor((duration_ms - lasts - first) / period));
}

// The contraction of a wall under the pressures it was loaded with, from its equilibrium c at time 0 on.
// False, with the reason, when it stopped.
bool contract(const Ventricle& ventricle, const Protocol& protocol, const RunControl& control,
              const std::array<double, 2>& pressures_kPa, const Vector& c, HeartPath& path) {
  const double duration = protocol.time.duration_ms, interval = protocol.output.interval_ms;
  const double onset = last_onset(*ventricle.contraction, duration);
  const TensionCurve& curve = ventricle.contraction->curve;
  const double relaxation = onset + curve.contraction_end_ms() - curve.contraction_begin_ms();
  const int most = most_steps(protocol.time, duration);
  PressedWall system(ventricle, pressures_kPa);
  const auto state = [&](double t, const Vector& y) { return state_of(ventricle, t, y, pressures_kPa); };
  path.steps = path.outputs;
  if (onset <= 0) path.contraction_begins = path.steps.front();
  polyaffine::DaeIntegrator ida(system, system.options(protocol.time), 0, c, Vector::Zero(c.size()));
  Vector at;
  const auto interpolated = [&](double t) {
    ida.interpolate(std::min(t, ida.time()), at);
    return state(t, at);
  };
  std::string stop;
  while (stop.empty() && ida.time() < duration * (1 - 1e-12)) {
    if (ida.step(duration) == polyaffine::DaeStatus::failed) {
      stop = ida.failure();
      break;
    }
    path.steps.push_back(state(ida.time(), ida.y()));
    for (double t = interval * static_cast<double>(path.outputs.size()); t <= ida.time() + 1e-9;
         t = interval * static_cast<double>(path.outputs.size()))
      path.outputs.push_back(interpolated(t));
    if (!path.contraction_begins && onset <= ida.time()) path.contraction_begins = interpolated(onset);
    if (!path.contraction_ends && relaxation <= ida.time()) path.contraction_ends = interpolated(relaxation);
    path.min_det_F = std::min(path.min_det_F, system.min_det());
    path.max_det_F = std::max(path.max_det_F, system.max_det());
    if (control.progress) control.progress("contraction", ida.time() / duration);
    if (std::ssize(path.steps) > most)
      stop = too_many_steps(most, path.steps.back().time_ms - path.steps.end()[-2].time_ms);
    else if (stop_wanted(control))
      stop = control.stop_reason();
  }
  if (path.outputs.back().time_ms < path.steps.back().time_ms - 1e-9)
    path.outputs.push_back(path.steps.back());
  const auto counters = ida.counters();
  path.time_steps += static_cast<int>(counters.steps);
  path.newton_iterations += static_cast<int>(counters.newton_iterations);
  if (stop.empty()) return true;
  path.stop_reason = "stopped at " + std::to_string(ida.time()) + " ms: " + stop;
  return false;
}

}  // namespace

HeartPath run_prescribed(const Ventricle& ventricle, const Protocol& protocol, const RunControl& control) {
  HeartPath path;
  Vector c = Vector::Zero(ventricle.num_coefficients());
  const double duration = protocol.time.duration_ms;
  const double target = protocol.cavities ? protocol.cavities->pressure_mmHg * kPa_per_mmHg : 0.0;
  const double right_target = protocol.cavities && ventricle.right_cavity
                                  ? protocol.cavities->right_pressure_mmHg * kPa_per_mmHg
                                  : 0.0;
  const auto system = ventricle.make_system();
  const auto follow = [&](const polyaffine::EquilibriumProblem& problem,
                          const std::function<double(double)>& time) {
    polyaffine::LoadOptions options;
    options.first_step = options.largest_step = 1.0 / protocol.time.load_steps;
    const auto record = [&](double load, const Vector& at) {
      path.outputs.push_back(state_of(ventricle, time(load), at, {load * target, load * right_target}));
      const auto wall = ventricle.wall->evaluate({at, problem.terms.front().state(load)});
      path.min_det_F = std::min(path.min_det_F, wall.min_det);
      path.max_det_F = std::max(path.max_det_F, wall.max_det);
      if (control.progress) control.progress("loading", load);
    };
    if (path.outputs.empty()) record(0, c);
    options.on_step = record;
    options.interrupted = [&] { return stop_wanted(control); };
    const auto report = polyaffine::load_stepping(problem, *system, c, options);
    path.time_steps += report.steps;
    path.newton_iterations += report.iterations;
    path.cuts += report.cuts;
    warn_of_instability(report, "load", path);
    if (!report.converged())
      path.stop_reason = "stopped at " + std::to_string(100 * report.reached) +
                         " % of the load: " + why_it_stopped(report, control);
    return report.converged();
  };

  const bool contracts = ventricle.contraction != nullptr;
  const Vector none;
  const Vector at_rest = contracts ? ventricle.contraction->tension(0) : none;
  const WallLoad unloaded{0, Vector::Zero(at_rest.size())};
  const WallLoad loaded{target, at_rest, right_target};
  path.completed = follow(loaded_ventricle(ventricle, unloaded, loaded),
                          [&](double load) { return contracts ? 0.0 : load * duration; });
  if (path.completed && contracts) {
    path.outputs.erase(path.outputs.begin(), path.outputs.end() - 1);
    path.completed = contract(ventricle, protocol, control, {target, right_target}, c, path);
  } else {
    path.steps = path.outputs;
  }
  path.simulated_ms = path.steps.back().time_ms;
  return path;
}

}  // namespace cardiac
