#include "cardiac/run/inflation.hpp"

#include <cardiac/model/vertex_displacement.hpp>
#include <cardiac/run/build_ventricle.hpp>
#include <cardiac/run/statics.hpp>

namespace cardiac {

using polyaffine::Vector;

namespace {

constexpr int kQuickly = 12;  // Newton's steps from the last equilibrium, before the load is raised from zero

// On the relaxed wall.
WallLoad load_of(const Ventricle& model, const Vector& pressures_kPa) {
  return {pressures_kPa, model.contraction ? Vector::Zero(model.contraction->delay_ms.size()) : Vector()};
}

}  // namespace

double Inflation::loaded_sum(const Vector& volumes_mm3) const {
  return (pressures_kPa_.array() > 0).select(volumes_mm3.array(), 0).sum();
}

bool Inflation::from_the_last(const Ventricle& model, const WallLoad& load, Vector& c) const {
  if (last_.size() != c.size()) return false;
  c = last_;
  const polyaffine::System system = loaded_ventricle(model, load, load);
  polyaffine::NewtonOptions options;
  options.max_iterations = kQuickly;
  const auto report = polyaffine::newton(system, 1, *system.make_linear(), c, options);
  return report.converged() && !report.unstable;
}

Inflated Inflation::inflate(const std::shared_ptr<const Anatomy>& shape, double wide, double volume_mm3) {
  const Ventricle model = build_ventricle(shape, scene_, scene_.reduction.method, control_);
  const WallLoad load = load_of(model, pressures_kPa_);
  Inflated out;
  Vector c = Vector::Zero(model.num_coefficients());
  out.free_mm3 = model.cavity_volumes(c);
  const double most_mm3 = wide * (volume_mm3 > 0 ? volume_mm3 : loaded_sum(out.free_mm3));
  out.reached = 1;
  if (!from_the_last(model, load, c)) {
    c.setZero();
    bool is_wide = false;
    polyaffine::LoadOptions options;
    options.on_step = [&](double, const Vector& at) {
      is_wide = loaded_sum(model.cavity_volumes(at)) > most_mm3;
    };
    options.interrupted = [&] { return is_wide || stop_wanted(control_); };
    const polyaffine::System system = loaded_ventricle(model, load);
    const auto report = polyaffine::load_stepping(system, *system.make_linear(), c, options);
    out.reached = report.reached;
    if (!report.converged() && !is_wide) out.why = why_it_stopped(report, control_);
  }
  if (out.whole()) last_ = c;
  out.loaded_mm3 = model.cavity_volumes(c);
  out.points = shape->mesh.points() + vertex_displacement(model).apply(c);
  return out;
}

std::vector<std::pair<double, Vector>> Inflation::fill(const std::shared_ptr<const Anatomy>& shape,
                                                       double factor, int steps) const {
  const Ventricle model = build_ventricle(shape, scene_, scene_.reduction.method, control_);
  Vector c = Vector::Zero(model.num_coefficients());
  std::vector<std::pair<double, Vector>> out{{0, model.cavity_volumes(c)}};
  polyaffine::LoadOptions options;
  options.first_step = options.largest_step = 1.0 / steps;
  options.on_step = [&](double load, const Vector& at) {
    out.emplace_back(factor * load, model.cavity_volumes(at));
  };
  options.interrupted = [&] { return stop_wanted(control_); };
  const polyaffine::System system = loaded_ventricle(model, load_of(model, factor * pressures_kPa_));
  polyaffine::load_stepping(system, *system.make_linear(), c, options);
  return out;
}

}  // namespace cardiac
