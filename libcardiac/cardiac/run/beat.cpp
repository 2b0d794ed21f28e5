#include "cardiac/run/beat.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iomanip>
#include <iterator>
#include <sstream>

#include "cardiac/model/coupled_heart.hpp"
#include "cardiac/run/beat_instants.hpp"
#include "cardiac/run/checkpoint.hpp"
#include "cardiac/run/statics.hpp"

#include <cardiac/core/units.hpp>
#include <cardiac/scene/loops.hpp>
#include <polyaffine/core/error.hpp>

namespace cardiac {

using polyaffine::Vector;

namespace {

// The state of a wall filled to the atrial pressures.
HeartState filled_state(const Ventricle& ventricle, const CirculationStart& start, const Vector& at) {
  HeartState out{0, at, ventricle.cavity_volumes(at), start.filling_kPa};
  out.vessels_kPa = start.states;
  return out;
}

void add_cost(const polyaffine::SystemCost& more, SolveCost& sum) {
  sum.residuals += more.residuals;
  sum.factorisations += more.factorisations;
  sum.linear_solves += more.linear_solves;
  sum.residual_s += more.residual_s;
  sum.tangent_s += more.tangent_s;
  sum.factorisation_s += more.factorisation_s;
  sum.linear_solve_s += more.linear_solve_s;
}

// The wall in equilibrium at the filling pressure. On failure the path says so.
bool fill(const Ventricle& ventricle, const Vector& pressures_kPa, const Vector& tension,
          const RunControl& control, HeartPath& path, Vector& c) {
  const polyaffine::System system = loaded_ventricle(ventricle, {pressures_kPa, tension});
  polyaffine::LoadOptions options;
  options.interrupted = [&] { return stop_wanted(control); };
  const auto report = polyaffine::load_stepping(system, *system.make_linear(), c, options);
  path.newton_iterations += report.iterations;
  path.cuts += report.cuts;
  warn_of_instability(report, "filling pressure", path);
  if (report.converged()) return true;
  const double filling_mmHg = pressures_kPa[0] / kPa_per_mmHg;
  path.stop_reason = "filling stopped at " + std::to_string(report.reached * filling_mmHg) + " of " +
                     std::to_string(filling_mmHg) + " mmHg: " + why_it_stopped(report, control);
  return false;
}

// Of the states those that may take beats to settle: volumes of the cavities and pressures of vessels.
// Chambers and flows follow them within a beat.
int num_slow(const CirculationModel& circulation) {
  return circulation.num_cavities() + circulation.kinds().pressures;
}

double stroke_volume(const std::vector<HeartState>& steps) {
  const auto volume = [](const HeartState& s) { return s.volumes_mm3[0]; };
  const auto [low, high] = std::ranges::minmax_element(steps, {}, volume);
  return volume(*high) - volume(*low);
}

// Beats that the slowest vessels need to come nearer by their whole distance, 1/(1 − e^(−T/RC)).
double beats_of_vessels(const CirculationModel& circulation, const Scene& scene) {
  const double RC_ms = circulation.slowest_ms();
  return RC_ms > 0 ? -1 / std::expm1(-scene.time.beat_ms / RC_ms) : 1;
}

// Of the last beat from its limit; where no estimate could be used, no less than the vessels may need.
double distance_percent(const HeartPath& path, const CirculationModel& circulation, const Scene& scene) {
  const CycleEstimate estimate = estimate_limit_cycle(path.cycle, circulation.num_cavities());
  return estimate.distance_percent * (estimate.extrapolated ? 1 : beats_of_vessels(circulation, scene));
}

// The limit cycle is reached when the last beat is near the one that would repeat itself, and the beat before
// confirms it.
bool closed(const HeartPath& path, const CirculationModel& circulation, const Scene& scene) {
  const double tolerance_percent = scene.time.limit_cycle_tolerance_percent;
  const auto& sv = path.stroke_volumes_mm3;
  return sv.size() > 1 &&
         std::abs(sv.back() - sv[sv.size() - 2]) <= tolerance_percent / 100 * std::abs(sv.back()) &&
         distance_percent(path, circulation, scene) <= tolerance_percent;
}

// Whether beats come no nearer. Each chamber of a network takes a beat more to follow its vessels.
bool ends_in_noise(const HeartPath& path, const CirculationModel& circulation) {
  constexpr int kFirst = 4;
  return path.beats > kFirst + circulation.kinds().volumes &&
         is_noise(path.cycle, circulation.num_cavities());
}

std::string unclosed_warning(const HeartPath& path, const CirculationModel& circulation, const Scene& scene) {
  const scene::Time& time = scene.time;
  std::ostringstream out;
  out << "the pressure-volume loop did not close to " << time.limit_cycle_tolerance_percent
      << " % (time.limit_cycle_tolerance_percent) in " << path.beats
      << (path.beats == 1 ? " beat: " : " beats: ");
  if (path.cycle.size() > 1)
    out << "the last is about " << std::setprecision(2) << distance_percent(path, circulation, scene)
        << " % from the one that would repeat itself; ";
  else
    out << "one beat does not tell how far it is from the one that would repeat itself; ";
  if (ends_in_noise(path, circulation))
    out << "from beat to beat this is noise of the time integration and comes no nearer: lower "
           "time.relative_tolerance ("
        << time.relative_tolerance << "), time.absolute_tolerance_mm (" << time.absolute_tolerance_mm
        << ") and time.absolute_tolerance_mmHg (" << time.absolute_tolerance_kPa / kPa_per_mmHg << ")";
  else
    out << "raise time.max_beats";
  return out.str();
}

// Begins the next beat with the vessels' pressures of the estimated limit, from what the last one ended with.
void extrapolate(const CoupledHeart& heart, polyaffine::LinearSystem& linear, double t, HeartPath& path,
                 Vector& y, Vector& rate) {
  const CycleEstimate limit = estimate_limit_cycle(path.cycle, heart.num_cavities());
  if (!limit.extrapolated) return;
  Vector wanted = limit.pressures_kPa;
  const polyaffine::Unknowns vessels{heart.vessels.first, static_cast<int>(wanted.size())};
  if (heart.circulation->is_closed()) {
    const Vector compliances = heart.circulation->compliances().segment(heart.num_cavities(), wanted.size());
    wanted.array() += compliances.dot(vessels.of(y) - wanted) / compliances.sum();
  }
  vessels.of(y) = wanted;
  add_cost(make_consistent(heart, linear, t, y, rate), path.cost);
}

// The beat that the path has come to, from and to (y, rate). False, with the reason, when it stopped.
bool run_beat(const CoupledHeart& heart, polyaffine::LinearSystem& linear, const Scene& scene,
              const ContractionField& contraction, const RunControl& control, Vector& y, Vector& rate,
              HeartPath& path) {
  const double period = contraction.curve.period_ms(), onset_ms = contraction_onset_ms(contraction);
  const int beat = path.beats;
  const double begin = beat * period, end = (beat + 1) * period;
  const double interval = scene.output.interval_ms;
  const int most = most_steps(scene.time, period);
  path.beat_start_ms = begin;
  path.steps = {heart.unpack(0, y)};
  path.outputs = path.steps;
  polyaffine::DaeIntegrator ida(heart.system, linear, dae_options(scene), begin, y, rate);
  BeatInstants instants(heart, begin, onset_ms, y, path);
  const int slow = num_slow(*heart.circulation);
  CycleBeat cycle{heart.states(y).head(slow), {}, 0};
  std::string stop;
  while (stop.empty() && ida.time() < end - 1e-9 * period) {
    const double from = ida.time();
    // The tension bends at the onset: a step across it would show end diastole contracting.
    const double limit = from < begin + onset_ms ? std::min(begin + onset_ms, end) : end;
    if (ida.step(limit) == polyaffine::DaeStatus::failed) {
      stop = ida.failure();
      break;
    }
    path.steps.push_back(heart.unpack(ida.time() - begin, ida.y()));
    instants.follow(ida, from);
    for (double t = begin + interval * static_cast<double>(path.outputs.size());
         t <= ida.time() + 1e-9 && t <= end + 1e-9;
         t = begin + interval * static_cast<double>(path.outputs.size())) {
      Vector at;
      ida.interpolate(std::min(t, ida.time()), at);
      path.outputs.push_back(heart.unpack(t - begin, at));
    }
    path.min_det_F = std::min(path.min_det_F, ida.min_det());
    path.max_det_F = std::max(path.max_det_F, ida.max_det());
    if (control.progress)
      control.progress("beat " + std::to_string(beat + 1), ida.time() / (period * scene.time.max_beats));
    if (std::ssize(path.steps) > most)
      stop = too_many_steps(most, path.steps.back().time_ms - path.steps.end()[-2].time_ms);
    else if (stop_wanted(control))
      stop = control.stop_reason();
  }
  y = ida.y();
  rate = ida.rate();
  const auto counters = ida.counters();
  path.simulated_ms = ida.time();
  path.time_steps += static_cast<int>(counters.steps);
  path.newton_iterations += static_cast<int>(counters.newton_iterations);
  path.cost.error_test_failures += counters.error_test_failures;
  path.cost.convergence_failures += counters.convergence_failures;
  add_cost(ida.cost(), path.cost);
  if (stop.empty()) {
    cycle.end = heart.states(y).head(slow);
    cycle.stroke_mm3 = stroke_volume(path.steps);
    path.stroke_volumes_mm3.push_back(cycle.stroke_mm3);
    path.cycle.push_back(std::move(cycle));
    return true;
  }
  path.stop_reason =
      "stopped at " + std::to_string(ida.time()) + " ms (beat " + std::to_string(beat + 1) + "): " + stop;
  return false;
}

// The wall filled, and (y, rate) when the first beat begins. False, with the reason, when it stopped.
bool begin_beats(const Ventricle& ventricle, const Scene& scene, const RunControl& control,
                 const CoupledHeart& heart, polyaffine::LinearSystem& linear, Vector& y, Vector& rate,
                 HeartPath& path) {
  const CirculationStart start = circulation_start(ventricle.cavities.size() > 1, scene);
  Vector c = Vector::Zero(ventricle.num_coefficients());
  const auto begin = std::chrono::steady_clock::now();
  const bool filled = fill(ventricle, start.filling_kPa, ventricle.tension_at(0), control, path, c);
  path.cost.filling_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (!filled) return false;
  y = heart.pack(filled_state(ventricle, start, c));
  rest_muscle(heart.system, 0, y);
  rate = Vector::Zero(y.size());
  add_cost(make_consistent(heart, linear, 0, y, rate), path.cost);
  return true;
}

// Where an earlier run came to.
void take_up(const Checkpoint& from, const CoupledHeart& heart, Vector& y, Vector& rate, HeartPath& path) {
  if (from.y.size() != heart.system.size())
    throw polyaffine::InputError("the checkpoint holds " + std::to_string(from.y.size()) +
                                 " unknowns, expected " + std::to_string(heart.system.size()));
  for (const CycleBeat& beat : from.cycle)
    if (beat.start.size() != num_slow(*heart.circulation))
      throw polyaffine::InputError("the checkpoint's beats hold " + std::to_string(beat.start.size()) +
                                   " states of the circulation, expected " +
                                   std::to_string(num_slow(*heart.circulation)));
  y = from.y;
  rate = from.rate;
  path.beats = from.beats;
  path.time_steps = from.time_steps;
  path.newton_iterations = from.newton_iterations;
  path.stroke_volumes_mm3 = from.stroke_volumes_mm3;
  path.cycle = from.cycle;
  path.min_det_F = from.min_det_F;
  path.max_det_F = from.max_det_F;
  path.cost = from.cost;
}

Checkpoint checkpoint(const HeartPath& path, const Vector& y, const Vector& rate) {
  return {path.beats,
          path.time_steps,
          path.newton_iterations,
          path.stroke_volumes_mm3,
          path.cycle,
          path.min_det_F,
          path.max_det_F,
          path.cost,
          y,
          rate};
}

}  // namespace

HeartPath run_beats(const Ventricle& ventricle, const Scene& scene, const RunControl& control) {
  const CoupledHeart heart =
      couple(ventricle, circulation_model(ventricle.cavities.size() > 1, scene), scene.time);
  // One for all beats: its analysis takes as long as some steps.
  const auto linear = heart.system.make_linear();
  HeartPath path;
  ++path.built["circulation"];
  Vector y, rate;
  bool going_on = true, is_closed = false;
  if (control.resume)
    take_up(*control.resume, heart, y, rate, path);
  else
    going_on = begin_beats(ventricle, scene, control, heart, *linear, y, rate, path);
  while (going_on && !path.completed) {
    if (control.on_checkpoint) control.on_checkpoint(checkpoint(path, y, rate));
    going_on = run_beat(heart, *linear, scene, *ventricle.contraction, control, y, rate, path);
    if (!going_on) break;
    ++path.beats;
    is_closed = closed(path, *heart.circulation, scene);
    path.completed =
        is_closed || path.beats == scene.time.max_beats || ends_in_noise(path, *heart.circulation);
    if (!path.completed) extrapolate(heart, *linear, path.simulated_ms, path, y, rate);
  }
  if (path.completed && !is_closed)
    path.warnings.push_back(unclosed_warning(path, *heart.circulation, scene));
  return path;
}

}  // namespace cardiac
