#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <cardiac/circulation/given_volumes.hpp>
#include <cardiac/core/units.hpp>
#include <cardiac/model/coupled_heart.hpp>
#include <cardiac/run/beat_instants.hpp>
#include <cardiac/run/statics.hpp>

namespace cardiac {

using polyaffine::Matrix;
using polyaffine::Vector;

namespace {

// The pressures (kPa) that a scene prescribes in the cavities over the time: numbers, or curves.
std::vector<polyaffine::FieldTerm::Scale> prescribed_pressures(const Ventricle& ventricle,
                                                               const Scene& scene) {
  const auto cavities = std::max<std::ptrdiff_t>(1, std::ssize(ventricle.cavities));
  std::vector<polyaffine::FieldTerm::Scale> out(static_cast<std::size_t>(cavities),
                                                [](double) { return 0.0; });
  if (!scene.cavities) return out;
  const std::array<double, 2> constant{scene.cavities->pressure_kPa, scene.cavities->right_pressure_kPa};
  const auto& given = scene.cavities->curves;
  for (std::size_t k = 0; k < out.size(); ++k) {
    if (given && k < given->curves.size())
      out[k] = [curve = given->curves[k]](double t) { return curve.at(t).first; };
    else
      out[k] = [p = constant[k]](double) { return p; };
  }
  return out;
}

Vector at_time(const std::vector<polyaffine::FieldTerm::Scale>& pressures_kPa, double t) {
  Vector out(static_cast<Eigen::Index>(pressures_kPa.size()));
  for (Eigen::Index k = 0; k < out.size(); ++k) out[k] = pressures_kPa[static_cast<std::size_t>(k)](t);
  return out;
}

// A wall without a cavity is told as one whose volume is no number.
HeartState state_of(const Ventricle& ventricle, double t, const Vector& c, const Vector& pressures_kPa) {
  if (ventricle.cavities.empty())
    return {t, c, Vector::Constant(1, std::numeric_limits<double>::quiet_NaN()), pressures_kPa};
  return {t, c, ventricle.cavity_volumes(c), pressures_kPa};
}

void widen(double min_det, double max_det, HeartPath& path) {
  path.min_det_F = std::min(path.min_det_F, min_det);
  path.max_det_F = std::max(path.max_det_F, max_det);
}

// Begin of the last contraction that ends within the duration; of the first where none does.
double last_onset(const ContractionField& contraction, double duration_ms) {
  const TensionCurve& curve = contraction.curve;
  const double first = contraction_onset_ms(contraction), period = curve.period_ms();
  const double lasts = curve.contraction_end_ms() - curve.contraction_begin_ms();
  return first + period * std::max(0.0, std::floor((duration_ms - lasts - first) / period));
}

// The wall from rest to the pressures, at the tension of time 0, told at every equilibrium on the way; the
// time of the loading is `lasts_ms`. False, with the reason, when it stopped.
bool load_wall(const Ventricle& ventricle, const Scene& scene, const RunControl& control,
               const Vector& pressures_kPa, double lasts_ms, Vector& c, HeartPath& path) {
  const Vector tension = ventricle.tension_at(0);
  const polyaffine::System system = loaded_ventricle(ventricle, {pressures_kPa, tension});
  const auto tell = [&](double load, const Vector& at) {
    path.outputs.push_back(state_of(ventricle, load * lasts_ms, at, load * pressures_kPa));
    const auto residual = system.residual({load, at});
    widen(residual.min_det, residual.max_det, path);
    if (control.progress) control.progress("loading", load);
  };
  tell(0, c);
  polyaffine::LoadOptions options;
  options.first_step = options.largest_step = 1.0 / scene.time.load_steps;
  options.on_step = tell;
  options.interrupted = [&] { return stop_wanted(control); };
  const auto report = polyaffine::load_stepping(system, *system.make_linear(), c, options);
  path.time_steps += report.steps;
  path.newton_iterations += report.iterations;
  path.cuts += report.cuts;
  warn_of_instability(report, "load", path);
  if (!report.converged())
    path.stop_reason = "stopped at " + std::to_string(100 * report.reached) +
                       " % of the load: " + why_it_stopped(report, control);
  return report.converged();
}

// The pressures under which the wall at rest, at the tension of time 0, encloses the volumes, by Broyden's
// method from no pressure; c becomes its equilibrium. None, with the reason, where it stopped.
std::optional<Vector> pressures_of(const Ventricle& ventricle, const Scene& scene, const RunControl& control,
                                   const Vector& volumes_mm3, Vector& c, HeartPath& path) {
  constexpr int kMostSteps = 40;
  constexpr double kClose = 1e-6;     // of the volumes, relative
  constexpr double kProbe_kPa = 0.1;  // by which the first compliance is measured
  const Vector tension = ventricle.tension_at(0);
  const auto m = volumes_mm3.size();
  Vector p = Vector::Zero(m);
  bool first = true;
  const auto solve = [&](const Vector& to) {
    const polyaffine::System system = first ? loaded_ventricle(ventricle, {to, tension})
                                            : loaded_ventricle(ventricle, {p, tension}, {to, tension});
    first = false;
    polyaffine::LoadOptions options;
    options.first_step = options.largest_step = 1.0 / scene.time.load_steps;
    options.interrupted = [&] { return stop_wanted(control); };
    const auto report = polyaffine::load_stepping(system, *system.make_linear(), c, options);
    path.time_steps += report.steps;
    path.newton_iterations += report.iterations;
    path.cuts += report.cuts;
    if (report.converged()) {
      p = to;
      return true;
    }
    path.stop_reason =
        "stopped on the way to the first volume that is given: " + why_it_stopped(report, control);
    return false;
  };
  if (!solve(p)) return {};
  Vector missing = volumes_mm3 - ventricle.cavity_volumes(c);
  Matrix stiffness(m, m);  // ∂p/∂V
  for (Eigen::Index k = 0; k < m; ++k) {
    const Vector before = p;
    if (!solve(p + kProbe_kPa * Vector::Unit(m, k))) return {};
    const Vector now = volumes_mm3 - ventricle.cavity_volumes(c);
    stiffness.col(k) = (missing - now) / kProbe_kPa;
    missing = now;
  }
  stiffness = stiffness.inverse().eval();
  for (int step = 0; step < kMostSteps; ++step) {
    if (missing.cwiseQuotient(volumes_mm3).cwiseAbs().maxCoeff() <= kClose) return p;
    const Vector change = stiffness * missing;
    if (!solve(p + change)) return {};
    const Vector now = volumes_mm3 - ventricle.cavity_volumes(c);
    const Vector moved = stiffness * (missing - now);
    stiffness += (change - moved) * (change.transpose() * stiffness) / change.dot(moved);
    missing = now;
  }
  path.stop_reason = "found no pressure at which the wall encloses the first volume that is given";
  return {};
}

// A wall in time from time 0 on, under given pressures or around given volumes.
class WallInTime {
 public:
  // From its equilibrium c under pressures p(0).
  WallInTime(const Ventricle& ventricle, const Scene& scene,
             std::vector<polyaffine::FieldTerm::Scale> pressures_kPa, const Vector& c, HeartPath& path)
      : ventricle_(ventricle),
        scene_(scene),
        pressures_kPa_(std::move(pressures_kPa)),
        path_(path),
        system_(pressed_system(ventricle, ventricle.tension(), pressures_kPa_,
                               scene.time.absolute_tolerance_mm)) {
    add_states(ventricle, scene.time, system_);
    Vector y = Vector::Zero(system_.size());
    system_.layout.field().of(y) = c;
    rest_muscle(system_, 0, y);
    begin(std::move(y), Vector::Zero(system_.size()));
  }

  // From its equilibrium c under pressures p, around volumes that follow their curves.
  WallInTime(const Ventricle& ventricle, const Scene& scene, const GivenCavities& given, const Vector& p,
             const Vector& c, HeartPath& path)
      : ventricle_(ventricle),
        scene_(scene),
        path_(path),
        heart_(couple(ventricle, std::make_shared<GivenVolumes>(given.curves), scene.time)),
        system_(heart_->system) {
    Vector y = heart_->pack({0, c, ventricle.cavity_volumes(c), p});
    rest_muscle(system_, 0, y);
    Vector rate = Vector::Zero(y.size());
    make_consistent(*heart_, *system_.make_linear(), 0, y, rate);
    begin(std::move(y), std::move(rate));
  }

  // False, with the reason, when it stopped.
  bool run(const RunControl& control) {
    const double duration = scene_.time.duration_ms;
    const int most = most_steps(scene_.time, duration);
    path_.outputs = {at(0)};  // the end of the loading, which took no time
    path_.steps = path_.outputs;
    if (ventricle_.contraction && onset_ms_ <= 0) path_.contraction_begins = path_.steps.front();
    std::string stop;
    while (stop.empty() && ida_->time() < duration * (1 - 1e-12)) {
      if (ida_->step(duration) == polyaffine::DaeStatus::failed) {
        stop = ida_->failure();
        break;
      }
      tell_step();
      if (control.progress) control.progress("contraction", ida_->time() / duration);
      if (std::ssize(path_.steps) > most)
        stop = too_many_steps(most, path_.steps.back().time_ms - path_.steps.end()[-2].time_ms);
      else if (stop_wanted(control))
        stop = control.stop_reason();
    }
    if (path_.outputs.back().time_ms < path_.steps.back().time_ms - 1e-9)
      path_.outputs.push_back(path_.steps.back());
    const auto counters = ida_->counters();
    path_.time_steps += static_cast<int>(counters.steps);
    path_.newton_iterations += static_cast<int>(counters.newton_iterations);
    if (!stop.empty()) path_.stop_reason = "stopped at " + std::to_string(ida_->time()) + " ms: " + stop;
    return stop.empty();
  }

 private:
  void begin(Vector y, Vector rate) {
    ida_.emplace(system_, dae_options(scene_), 0, y, rate);
    start_ = std::move(y);
    if (!ventricle_.contraction) return;
    const TensionCurve& curve = ventricle_.contraction->curve;
    onset_ms_ = last_onset(*ventricle_.contraction, scene_.time.duration_ms);
    relaxation_ms_ = onset_ms_ + curve.contraction_end_ms() - curve.contraction_begin_ms();
  }

  HeartState state(double t, const Vector& y) const {
    if (heart_) return heart_->unpack(t, y);
    HeartState out = state_of(ventricle_, t, system_.layout.field().of(y), at_time(pressures_kPa_, t));
    out.tension_kPa = muscle_tension(system_, y);
    return out;
  }
  HeartState at(double t) const {
    if (t <= 0) return state(0, start_);
    Vector y;
    ida_->interpolate(std::min(t, ida_->time()), y);
    return state(t, y);
  }

  // The step taken last, and what lies within it.
  void tell_step() {
    path_.steps.push_back(state(ida_->time(), ida_->y()));
    const double interval = scene_.output.interval_ms;
    for (double t = interval * static_cast<double>(path_.outputs.size()); t <= ida_->time() + 1e-9;
         t = interval * static_cast<double>(path_.outputs.size()))
      path_.outputs.push_back(at(t));
    widen(ida_->min_det(), ida_->max_det(), path_);
    if (!ventricle_.contraction) return;
    if (!path_.contraction_begins && onset_ms_ <= ida_->time()) path_.contraction_begins = at(onset_ms_);
    if (!path_.contraction_ends && relaxation_ms_ <= ida_->time())
      path_.contraction_ends = at(relaxation_ms_);
  }

  const Ventricle& ventricle_;
  const Scene& scene_;
  std::vector<polyaffine::FieldTerm::Scale> pressures_kPa_;
  HeartPath& path_;
  std::optional<CoupledHeart> heart_;
  polyaffine::System system_;
  std::optional<polyaffine::DaeIntegrator> ida_;
  Vector start_;
  double onset_ms_ = 0, relaxation_ms_ = 0;
};

}  // namespace

HeartPath run_prescribed(const Ventricle& ventricle, const Scene& scene, const RunControl& control) {
  HeartPath path;
  Vector c = Vector::Zero(ventricle.num_coefficients());
  const GivenCavities* given = scene.cavities ? scene.cavities->curves.get() : nullptr;
  if (given != nullptr && given->are_volumes) {
    Vector volumes(std::ssize(given->curves));
    for (Eigen::Index k = 0; k < volumes.size(); ++k)
      volumes[k] = given->curves[static_cast<std::size_t>(k)].at(0).first;
    const auto p = pressures_of(ventricle, scene, control, volumes, c, path);
    if (p)
      path.completed = WallInTime(ventricle, scene, *given, *p, c, path).run(control);
    else
      path.steps = path.outputs = {state_of(ventricle, 0, c, Vector::Zero(volumes.size()))};
  } else {
    const auto pressures = prescribed_pressures(ventricle, scene);
    const bool in_time = ventricle.contraction != nullptr || given != nullptr;
    const double loading_ms = in_time ? 0 : scene.time.duration_ms;
    path.completed = load_wall(ventricle, scene, control, at_time(pressures, 0), loading_ms, c, path);
    if (path.completed && in_time)
      path.completed = WallInTime(ventricle, scene, pressures, c, path).run(control);
    else
      path.steps = path.outputs;
  }
  path.simulated_ms = path.steps.back().time_ms;
  return path;
}

}  // namespace cardiac
