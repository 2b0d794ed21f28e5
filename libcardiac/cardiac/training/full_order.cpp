#include "cardiac/training/full_order.hpp"

#include <algorithm>
#include <utility>

#include <polyaffine/solve/load_stepping.hpp>
#include <polyaffine/system/linearised.hpp>

namespace cardiac {

using polyaffine::Matrix;
using polyaffine::System;
using polyaffine::Vector;

namespace {

// Far below any error of a reduced model.
constexpr double kTolerance = 1e-7;

// Share to which a step with an old tangent must lower the residuals; a new one costs twenty such steps.
constexpr double kContraction = 0.3;

// ∇u by which a linear answer may move a point: beyond it stiff fibres would make wild forces.
constexpr double kLargestStep = 0.4;

double largest_gradient(const polyaffine::FieldTable& table, const Vector& u) {
  const Matrix F = polyaffine::evaluate_field(table, u);
  return (F.colwise() - polyaffine::Mat3::Identity().reshaped()).colwise().norm().maxCoeff();
}

WallLoad no_load(const Ventricle& ventricle) {
  TrainingLoad none;
  none.pressures_kPa = Vector::Zero(std::ssize(ventricle.cavities));
  none.level = 0;
  return wall_load(ventricle, none);
}

// Newton's method in the mixed form from a displacement and the pressures of the elements. A reduced model's
// displacement would make wild pressures by itself.
bool newton_from(const FullState& near, const System& system, polyaffine::LinearSystem& linear,
                 const polyaffine::NewtonOptions& options, Vector& u, Vector& pressure) {
  const System mixed = polyaffine::mixed_form(system);
  Vector y = polyaffine::mixed_start(mixed, 1, near.u);
  if (y.size() == near.u.size() + near.pressure.size()) y.tail(near.pressure.size()) = near.pressure;
  polyaffine::Newton newton(mixed, linear);
  if (!newton.solve(1, polyaffine::rest_state(mixed, 1, y), y, options).converged()) return false;
  u = y.head(near.u.size());
  pressure = y.tail(y.size() - u.size());
  return true;
}

}  // namespace

Scene with_regions(const Scene& scene, const TrainingLoad& load) {
  Scene out = scene;
  out.regions.insert(out.regions.end(), load.regions.begin(), load.regions.end());
  return out;
}

WallLoad wall_load(const Ventricle& ventricle, const TrainingLoad& load) {
  WallLoad out{load.pressures_kPa, {}};
  if (ventricle.contraction) out.tension = load.level * ventricle.contraction->tension(load.clock_ms);
  return out;
}

FullOrder::FullOrder(std::shared_ptr<const Anatomy> anatomy, const Scene& scene)
    : anatomy_(std::move(anatomy)),
      scene_(scene),
      discretisation_(discretise(anatomy_, scene, scene::Method::fem)),
      plain_(assemble_ventricle(anatomy_, scene, discretisation_)),
      linear_(loaded_ventricle(plain_, no_load(plain_)).make_linear()) {}

Ventricle FullOrder::ventricle(const TrainingLoad& load) const {
  if (load.regions.empty()) return plain_;
  return assemble_ventricle(anatomy_, with_regions(scene_, load), discretisation_);
}

polyaffine::NewtonOptions FullOrder::newton_options() const {
  polyaffine::NewtonOptions out;
  out.tolerance = out.defect_tolerance = kTolerance;
  out.contraction = kContraction;
  out.on_iteration = watch;
  return out;
}

bool FullOrder::step_to(const System& system, Vector& u) {
  polyaffine::LoadOptions options;
  options.newton = newton_options();
  return polyaffine::load_stepping(system, *linear_, u, options).converged();
}

std::optional<FullState> FullOrder::solve(const TrainingLoad& load, const FullState* guess) {
  ++solves_;
  const Ventricle v = ventricle(load);
  const System system = loaded_ventricle(v, wall_load(v, load));
  FullState out{load, {}, {}};
  if (guess && newton_from(*guess, system, *linear_, newton_options(), out.u, out.pressure)) return out;
  out.u = Vector::Zero(v.num_coefficients());
  if (!step_to(system, out.u)) return std::nullopt;
  if (v.wall->pressure_space()) out.pressure = v.wall->pressure(out.u);
  return out;
}

std::optional<FullState> FullOrder::follow(const TrainingLoad& load, const FullState& from) {
  FullState out{load, from.u, {}};
  const System between = loaded_ventricle(plain_, wall_load(plain_, from.load), wall_load(plain_, load));
  if (!step_to(between, out.u)) return solve(load, nullptr);
  ++solves_;
  if (plain_.wall->pressure_space()) out.pressure = plain_.wall->pressure(out.u);
  return out;
}

std::vector<FullState> FullOrder::linear_answers(const FullState& state,
                                                 const std::vector<scene::RegionOverride>& changes) {
  const Ventricle v = ventricle(state.load);
  const WallLoad load = wall_load(v, state.load);
  const System system = loaded_ventricle(v, load);
  polyaffine::Linearised tangent(system, *linear_);
  if (!tangent.factorise({1, state.u}, 0)) return {};
  const bool mixed = v.wall->pressure_space().has_value();
  const auto force = [&](const Ventricle& of, const WallLoad& at) {
    return of.wall->evaluate({state.u, at.state(), nullptr, mixed ? &state.pressure : nullptr}).gradient;
  };
  const Vector before = force(v, load);
  Matrix rhs(state.u.size(), std::ssize(changes));
  std::vector<FullState> out;
  for (std::size_t k = 0; k < changes.size(); ++k) {
    TrainingLoad changed = state.load;
    changed.regions.push_back(changes[k]);
    const Ventricle other = ventricle(changed);
    rhs.col(static_cast<Eigen::Index>(k)) = before - force(other, wall_load(other, changed));
    out.push_back({std::move(changed), {}, {}});
  }
  for (std::size_t i = 0; i < discretisation_.fixed.size(); ++i)
    if (discretisation_.fixed[i]) rhs.row(static_cast<Eigen::Index>(i)).setZero();
  const Matrix answers = linear_->solve(rhs);
  polyaffine::VolumeGradient D;
  if (mixed) D = v.wall->volume_gradient(state.u);
  for (std::size_t k = 0; k < out.size(); ++k) {
    const Vector whole = answers.col(static_cast<Eigen::Index>(k));
    const double share = std::min(1.0, kLargestStep / largest_gradient(v.wall->table(), whole));
    scene::RegionOverride& region = out[k].load.regions.back();
    region.tension_factor = 1 + share * (region.tension_factor - 1);
    region.stiffness_factor = 1 + share * (region.stiffness_factor - 1);
    const Vector step = share * whole;
    out[k].u = state.u + step;
    if (mixed) out[k].pressure = state.pressure + v.wall->penalty_pressure(D.times(step));
  }
  return out;
}

std::vector<FullState> FullOrder::answers(const FullState& state,
                                          const std::vector<scene::RegionOverride>& changes) {
  std::vector<FullState> out;
  for (const FullState& near : linear_answers(state, changes)) {
    const Ventricle v = ventricle(near.load);
    const System system = loaded_ventricle(v, wall_load(v, near.load));
    FullState found{near.load, {}, {}};
    ++solves_;
    if (newton_from(near, system, *linear_, newton_options(), found.u, found.pressure))
      out.push_back(std::move(found));
  }
  return out;
}

}  // namespace cardiac
