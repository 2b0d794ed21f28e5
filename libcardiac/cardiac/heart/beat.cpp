#include "cardiac/heart/beat.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>

#include "cardiac/heart/beat_system.hpp"
#include "cardiac/heart/checkpoint.hpp"

#include <cardiac/core/units.hpp>
#include <polyaffine/core/error.hpp>

namespace cardiac {

using polyaffine::Vector;

LeftHeartLoop left_heart_loop(const protocol::Circulation& c) {
  LeftHeartLoop loop;
  loop.filling_pressure_kPa = c.filling_pressure_mmHg * kPa_per_mmHg;
  loop.mitral.resistance_kPa_ms_per_mm3 = c.mitral_resistance_mmHg_s_per_mL * resistance_per_mmHg_s_per_mL;
  loop.aortic.resistance_kPa_ms_per_mm3 =
      c.aortic_valve_resistance_mmHg_s_per_mL * resistance_per_mmHg_s_per_mL;
  if (c.aortic_leak_resistance_mmHg_s_per_mL)
    loop.aortic.leak_kPa_ms_per_mm3 = *c.aortic_leak_resistance_mmHg_s_per_mL * resistance_per_mmHg_s_per_mL;
  loop.arteries = {c.characteristic_resistance_mmHg_s_per_mL * resistance_per_mmHg_s_per_mL,
                   c.peripheral_resistance_mmHg_s_per_mL * resistance_per_mmHg_s_per_mL,
                   c.compliance_mL_per_mmHg * compliance_per_mL_per_mmHg,
                   c.venous_pressure_mmHg * kPa_per_mmHg};
  return loop;
}

TwoSidedLoop two_sided_loop(const protocol::Circulation& c) {
  const LeftHeartLoop left = left_heart_loop(c);
  TwoSidedLoop loop;
  loop.left.inlet = left.mitral;
  loop.left.outlet = left.aortic;
  loop.left.arteries = left.arteries;
  loop.left.venous_compliance_mm3_per_kPa =
      c.pulmonary_venous_compliance_mL_per_mmHg * compliance_per_mL_per_mmHg;
  loop.right.inlet.resistance_kPa_ms_per_mm3 =
      c.tricuspid_resistance_mmHg_s_per_mL * resistance_per_mmHg_s_per_mL;
  loop.right.outlet.resistance_kPa_ms_per_mm3 =
      c.pulmonary_valve_resistance_mmHg_s_per_mL * resistance_per_mmHg_s_per_mL;
  loop.right.arteries = {c.pulmonary_characteristic_resistance_mmHg_s_per_mL * resistance_per_mmHg_s_per_mL,
                         c.pulmonary_peripheral_resistance_mmHg_s_per_mL * resistance_per_mmHg_s_per_mL,
                         c.pulmonary_compliance_mL_per_mmHg * compliance_per_mL_per_mmHg, 0};
  loop.right.venous_compliance_mm3_per_kPa =
      c.systemic_venous_compliance_mL_per_mmHg * compliance_per_mL_per_mmHg;
  return loop;
}

namespace {

bool stop_wanted(const RunControl& control) {
  return control.stop_reason && !control.stop_reason().empty();
}

std::string why(const polyaffine::LoadReport& report, const RunControl& control) {
  if (report.reason == polyaffine::StopReason::interrupted) return control.stop_reason();
  if (report.reached == 0 && report.last.reason == polyaffine::StopReason::singular_tangent)
    return "the functions of the model are not independent (two control nodes in one place?), or a part of "
           "the wall is held by nothing";
  return "no equilibrium was found beyond it (" + polyaffine::to_string(report.last.reason) +
         "): a limit load, buckling, or a load too large for the tissue";
}

void warn_of_instability(const polyaffine::LoadReport& report, const std::string& load, HeartPath& path) {
  if (!report.unstable_from) return;
  path.warnings.push_back("from " + std::to_string(100 * *report.unstable_from) + " % of the " + load +
                          " on the equilibrium is no minimum of the energy: the wall may buckle, and there "
                          "may be other solutions");
}

std::shared_ptr<const CirculationModel> circulation_model(const Ventricle& ventricle,
                                                          const protocol::Circulation& c) {
  if (ventricle.right_cavity) return std::make_shared<TwoSidedCirculation>(two_sided_loop(c));
  return std::make_shared<LeftHeartCirculation>(left_heart_loop(c));
}

// The state of a wall filled to the atrial pressures.
HeartState filled_state(const Ventricle& ventricle, const protocol::Circulation& c, const Vector& at) {
  HeartState out{0, at, ventricle.cavity_volume(at), c.filling_pressure_mmHg * kPa_per_mmHg,
                 c.initial_aortic_pressure_mmHg * kPa_per_mmHg};
  if (!ventricle.right_cavity) return out;
  out.right_volume_mm3 = ventricle.right_cavity->evaluate({at}).value;
  out.right_pressure_kPa = c.right_filling_pressure_mmHg * kPa_per_mmHg;
  out.loop = Vector(3);
  out.loop << c.initial_pulmonary_pressure_mmHg, c.filling_pressure_mmHg, c.right_filling_pressure_mmHg;
  out.loop *= kPa_per_mmHg;
  return out;
}

// The wall in equilibrium at the filling pressure. On failure the path says so.
bool fill(const Ventricle& ventricle, const protocol::Circulation& circulation, const Vector& tension,
          const RunControl& control, HeartPath& path, Vector& c) {
  const auto problem = loaded_ventricle(ventricle, {circulation.filling_pressure_mmHg * kPa_per_mmHg, tension,
                                                    circulation.right_filling_pressure_mmHg * kPa_per_mmHg});
  const auto system = ventricle.make_system();
  polyaffine::LoadOptions options;
  options.interrupted = [&] { return stop_wanted(control); };
  const auto report = polyaffine::load_stepping(problem, *system, c, options);
  path.newton_iterations += report.iterations;
  path.cuts += report.cuts;
  warn_of_instability(report, "filling pressure", path);
  if (report.converged()) return true;
  path.stop_reason = "filling stopped at " +
                     std::to_string(report.reached * circulation.filling_pressure_mmHg) + " of " +
                     std::to_string(circulation.filling_pressure_mmHg) + " mmHg: " + why(report, control);
  return false;
}

// Time steps of one beat, some ten times as many as one needs.
int most_steps(const protocol::Time& time, double period_ms) {
  return std::max(2000, static_cast<int>(10 * std::ceil(period_ms / time.max_step_ms)));
}

double stroke_volume(const std::vector<HeartState>& steps) {
  const auto by_volume = [](const HeartState& a, const HeartState& b) { return a.volume_mm3 < b.volume_mm3; };
  const auto [low, high] = std::minmax_element(steps.begin(), steps.end(), by_volume);
  return high->volume_mm3 - low->volume_mm3;
}

// The limit cycle is reached when the stroke volume, the volumes and the pressures of the vessels come back.
bool closed(const HeartPath& path, double tolerance_percent) {
  const auto& sv = path.stroke_volumes_mm3;
  if (sv.size() < 2) return false;
  const double allowed = tolerance_percent / 100 * std::abs(sv.back());
  const HeartState &first = path.steps.front(), &last = path.steps.back();
  return std::abs(sv.back() - sv[sv.size() - 2]) <= allowed &&
         std::abs(last.volume_mm3 - first.volume_mm3) <= allowed &&
         std::abs(last.right_volume_mm3 - first.right_volume_mm3) <= allowed &&
         std::abs(last.capacitor_pressure_kPa - first.capacitor_pressure_kPa) <=
             tolerance_percent / 100 * last.capacitor_pressure_kPa &&
         ((last.loop - first.loop).array().abs() <= tolerance_percent / 100 * last.loop.array()).all();
}

// The beat that the path has come to, from and to (y, rate). False, with the reason, when it stopped.
bool run_beat(BeatSystem& system, const Protocol& protocol, double period, const RunControl& control,
              Vector& y, Vector& rate, HeartPath& path) {
  const int beat = path.beats;
  const double begin = beat * period, end = (beat + 1) * period;
  const double interval = protocol.output.interval_ms;
  const int most = most_steps(protocol.time, period);
  path.beat_start_ms = begin;
  path.steps = {system.unpack(begin, begin, y)};
  path.outputs = path.steps;
  polyaffine::DaeIntegrator ida(system, system.options(protocol.time), begin, y, rate);
  std::string stop;
  while (stop.empty() && ida.time() < end - 1e-9 * period) {
    if (ida.step(end) == polyaffine::DaeStatus::failed) {
      stop = ida.failure();
      break;
    }
    path.steps.push_back(system.unpack(ida.time(), begin, ida.y()));
    for (double t = begin + interval * static_cast<double>(path.outputs.size());
         t <= ida.time() + 1e-9 && t <= end + 1e-9;
         t = begin + interval * static_cast<double>(path.outputs.size())) {
      Vector at;
      ida.interpolate(std::min(t, ida.time()), at);
      path.outputs.push_back(system.unpack(t, begin, at));
    }
    path.min_det_F = std::min(path.min_det_F, system.min_det());
    path.max_det_F = std::max(path.max_det_F, system.max_det());
    if (control.progress)
      control.progress("beat " + std::to_string(beat + 1), ida.time() / (period * protocol.time.max_beats));
    if (std::ssize(path.steps) > most)
      stop = std::to_string(most) + " time steps in one beat; the last was " +
             std::to_string(path.steps.back().time_ms - path.steps.end()[-2].time_ms) +
             " ms; a softer tissue, more viscosity or larger tolerances (time.*) let it go on";
    else if (stop_wanted(control))
      stop = control.stop_reason();
  }
  y = ida.y();
  rate = ida.rate();
  const auto counters = ida.counters();
  path.simulated_ms = ida.time();
  path.time_steps += static_cast<int>(counters.steps);
  path.newton_iterations += static_cast<int>(counters.newton_iterations);
  system.cost().error_test_failures += counters.error_test_failures;
  system.cost().convergence_failures += counters.convergence_failures;
  if (stop.empty()) return true;
  path.stop_reason =
      "stopped at " + std::to_string(ida.time()) + " ms (beat " + std::to_string(beat + 1) + "): " + stop;
  return false;
}

// The wall filled, and (y, rate) when the first beat begins. False, with the reason, when it stopped.
bool begin_beats(const Ventricle& ventricle, const Protocol& protocol, const RunControl& control,
                 BeatSystem& system, Vector& y, Vector& rate, HeartPath& path) {
  const protocol::Circulation& circulation = *protocol.circulation;
  Vector c = Vector::Zero(ventricle.num_coefficients());
  const auto begin = std::chrono::steady_clock::now();
  const bool filled = fill(ventricle, circulation, ventricle.contraction->tension(0), control, path, c);
  system.cost().filling_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (!filled) return false;
  HeartState start = filled_state(ventricle, circulation, c);
  rate = system.start_consistently(start);
  y = system.pack(start);
  return true;
}

// Where an earlier run came to.
void take_up(const Checkpoint& from, BeatSystem& system, Vector& y, Vector& rate, HeartPath& path) {
  if (from.y.size() != system.size())
    throw polyaffine::InputError("the checkpoint holds " + std::to_string(from.y.size()) +
                                 " unknowns, expected " + std::to_string(system.size()));
  y = from.y;
  rate = from.rate;
  path.beats = from.beats;
  path.time_steps = from.time_steps;
  path.newton_iterations = from.newton_iterations;
  path.stroke_volumes_mm3 = from.stroke_volumes_mm3;
  path.min_det_F = from.min_det_F;
  path.max_det_F = from.max_det_F;
  system.cost() = from.cost;
}

Checkpoint checkpoint(const HeartPath& path, const BeatSystem& system, const Vector& y, const Vector& rate) {
  return {path.beats,
          path.time_steps,
          path.newton_iterations,
          path.stroke_volumes_mm3,
          path.min_det_F,
          path.max_det_F,
          system.cost(),
          y,
          rate};
}

}  // namespace

HeartPath run_beats(const Ventricle& ventricle, const Protocol& protocol, const RunControl& control) {
  const double tolerance = protocol.time.limit_cycle_tolerance_percent;
  BeatSystem system(ventricle, circulation_model(ventricle, *protocol.circulation));
  HeartPath path;
  ++path.built["circulation"];
  Vector y, rate;
  bool going_on = true;
  if (control.resume)
    take_up(*control.resume, system, y, rate, path);
  else
    going_on = begin_beats(ventricle, protocol, control, system, y, rate, path);
  while (going_on && !path.completed) {
    if (control.on_checkpoint) control.on_checkpoint(checkpoint(path, system, y, rate));
    going_on = run_beat(system, protocol, ventricle.contraction->curve.period_ms(), control, y, rate, path);
    if (!going_on) break;
    ++path.beats;
    path.stroke_volumes_mm3.push_back(stroke_volume(path.steps));
    path.completed = closed(path, tolerance) || path.beats == protocol.time.max_beats;
  }
  path.cost = system.cost();
  if (path.completed && !closed(path, tolerance))
    path.warnings.push_back("the pressure-volume loop did not close to " + std::to_string(tolerance) +
                            " % in " + std::to_string(path.beats) + " beats; raise time.max_beats");
  return path;
}

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
                          const std::function<double(double)>& share,
                          const std::function<double(double)>& time) {
    polyaffine::LoadOptions options;
    options.first_step = options.largest_step = 1.0 / protocol.time.load_steps;
    const auto record = [&](double load, const Vector& at) {
      HeartState state{time(load), at, ventricle.cavity ? ventricle.cavity_volume(at) : 0.0,
                       share(load) * target, 0};
      if (ventricle.right_cavity) {
        state.right_volume_mm3 = ventricle.right_cavity->evaluate({at}).value;
        state.right_pressure_kPa = share(load) * right_target;
      }
      path.outputs.push_back(std::move(state));
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
      path.stop_reason =
          "stopped at " + std::to_string(100 * report.reached) + " % of the load: " + why(report, control);
    return report.converged();
  };

  const Vector none;
  const Vector at_rest = ventricle.contraction ? ventricle.contraction->tension(0) : none;
  const WallLoad unloaded{0, Vector::Zero(at_rest.size())};
  const WallLoad loaded{target, at_rest, right_target};
  const auto raising = loaded_ventricle(ventricle, unloaded, loaded);
  const bool contracts = ventricle.contraction != nullptr;
  path.completed = follow(
      raising, [](double load) { return load; },
      [&](double load) { return contracts ? 0.0 : load * duration; });
  if (path.completed && contracts) {
    Vector tension;
    auto problem = loaded_ventricle(ventricle, loaded, loaded);
    problem.terms.front().state = [&](double load) {
      tension = ventricle.contraction->tension(load * duration);
      return polyaffine::PointState(tension.data(), tension.size());
    };
    path.outputs.erase(path.outputs.begin(), path.outputs.end() - 1);
    path.completed = follow(
        problem, [](double) { return 1.0; }, [&](double load) { return load * duration; });
  }
  path.steps = path.outputs;
  path.simulated_ms = path.outputs.back().time_ms;
  return path;
}

}  // namespace cardiac
