#include <algorithm>
#include <cmath>
#include <limits>

#include <cardiac/core/units.hpp>
#include <cardiac/run/beat_instants.hpp>
#include <cardiac/run/statics.hpp>

namespace cardiac {

using polyaffine::Vector;

namespace {

// The pressures that a scene holds in the cavities, kPa.
Vector prescribed_pressures(const Ventricle& ventricle, const Scene& scene) {
  if (!scene.cavities) return Vector::Zero(std::max<std::ptrdiff_t>(1, std::ssize(ventricle.cavities)));
  const Vector both{{scene.cavities->pressure_kPa, scene.cavities->right_pressure_kPa}};
  return both.head(std::ssize(ventricle.cavities));
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
  const Vector tension = ventricle.contraction ? ventricle.contraction->tension(0) : Vector();
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

// The contraction of a wall under constant pressures, from its equilibrium c at time 0 on.
class Contraction {
 public:
  Contraction(const Ventricle& ventricle, const Scene& scene, const Vector& pressures_kPa, const Vector& c,
              HeartPath& path)
      : ventricle_(ventricle),
        protocol_(scene),
        pressures_kPa_(pressures_kPa),
        path_(path),
        system_(system_in_time(ventricle, scene, pressures_kPa)),
        ida_(system_, dae_options(scene.time), 0, at_rest(c), Vector::Zero(system_.size())),
        onset_ms_(last_onset(*ventricle.contraction, scene.time.duration_ms)) {
    const TensionCurve& curve = ventricle.contraction->curve;
    relaxation_ms_ = onset_ms_ + curve.contraction_end_ms() - curve.contraction_begin_ms();
  }

  // False, with the reason, when it stopped.
  bool run(const RunControl& control) {
    const double duration = protocol_.time.duration_ms;
    const int most = most_steps(protocol_.time, duration);
    path_.outputs = {path_.outputs.back()};  // the end of the loading, which took no time
    path_.steps = path_.outputs;
    if (onset_ms_ <= 0) path_.contraction_begins = path_.steps.front();
    std::string stop;
    while (stop.empty() && ida_.time() < duration * (1 - 1e-12)) {
      if (ida_.step(duration) == polyaffine::DaeStatus::failed) {
        stop = ida_.failure();
        break;
      }
      tell_step();
      if (control.progress) control.progress("contraction", ida_.time() / duration);
      if (std::ssize(path_.steps) > most)
        stop = too_many_steps(most, path_.steps.back().time_ms - path_.steps.end()[-2].time_ms);
      else if (stop_wanted(control))
        stop = control.stop_reason();
    }
    if (path_.outputs.back().time_ms < path_.steps.back().time_ms - 1e-9)
      path_.outputs.push_back(path_.steps.back());
    const auto counters = ida_.counters();
    path_.time_steps += static_cast<int>(counters.steps);
    path_.newton_iterations += static_cast<int>(counters.newton_iterations);
    if (!stop.empty()) path_.stop_reason = "stopped at " + std::to_string(ida_.time()) + " ms: " + stop;
    return stop.empty();
  }

 private:
  static polyaffine::System system_in_time(const Ventricle& ventricle, const Scene& scene,
                                           const Vector& pressures_kPa) {
    std::vector<polyaffine::FieldTerm::Scale> constant;
    for (const double p : pressures_kPa) constant.emplace_back([p](double) { return p; });
    polyaffine::System out =
        pressed_system(ventricle, ventricle.tension(), constant, scene.time.absolute_tolerance_mm);
    add_states(ventricle, scene.time, out);
    return out;
  }

  Vector at_rest(const Vector& c) const {
    Vector y = Vector::Zero(system_.size());
    system_.layout.field().of(y) = c;
    return y;
  }

  HeartState state(double t, const Vector& y) const {
    return state_of(ventricle_, t, system_.layout.field().of(y), pressures_kPa_);
  }
  HeartState at(double t) const {
    Vector y;
    ida_.interpolate(std::min(t, ida_.time()), y);
    return state(t, y);
  }

  // The step taken last, and what lies within it.
  void tell_step() {
    path_.steps.push_back(state(ida_.time(), ida_.y()));
    const double interval = protocol_.output.interval_ms;
    for (double t = interval * static_cast<double>(path_.outputs.size()); t <= ida_.time() + 1e-9;
         t = interval * static_cast<double>(path_.outputs.size()))
      path_.outputs.push_back(at(t));
    if (!path_.contraction_begins && onset_ms_ <= ida_.time()) path_.contraction_begins = at(onset_ms_);
    if (!path_.contraction_ends && relaxation_ms_ <= ida_.time()) path_.contraction_ends = at(relaxation_ms_);
    widen(ida_.min_det(), ida_.max_det(), path_);
  }

  const Ventricle& ventricle_;
  const Scene& protocol_;
  Vector pressures_kPa_;
  HeartPath& path_;
  polyaffine::System system_;
  polyaffine::DaeIntegrator ida_;
  double onset_ms_, relaxation_ms_ = 0;
};

}  // namespace

HeartPath run_prescribed(const Ventricle& ventricle, const Scene& scene, const RunControl& control) {
  HeartPath path;
  Vector c = Vector::Zero(ventricle.num_coefficients());
  const Vector pressures_kPa = prescribed_pressures(ventricle, scene);
  const bool contracts = ventricle.contraction != nullptr;
  const double loading_ms = contracts ? 0 : scene.time.duration_ms;
  path.completed = load_wall(ventricle, scene, control, pressures_kPa, loading_ms, c, path);
  if (path.completed && contracts)
    path.completed = Contraction(ventricle, scene, pressures_kPa, c, path).run(control);
  else
    path.steps = path.outputs;
  path.simulated_ms = path.steps.back().time_ms;
  return path;
}

}  // namespace cardiac
