#include "cardiac/training/error_check.hpp"

#include <cardiac/training/heart_modes.hpp>
#include <polyaffine/kinematics/nested_basis.hpp>
#include <polyaffine/system/linearised.hpp>

namespace cardiac {

using polyaffine::System;
using polyaffine::Vector;

std::optional<double> estimated_error(const ErrorCheck& check, const Ventricle& larger, const Ventricle& full,
                                      const NestedState& state) {
  const auto& functions = dynamic_cast<const polyaffine::NestedBasis&>(*larger.discretisation.basis);
  // Modes and pressures that the state does not have are zero.
  Vector c = Vector::Zero(larger.num_coefficients()), p = Vector::Zero(check.space.pressures.rows());
  c.head(state.c.size()) = state.c;
  p.head(state.pressure.size()) = state.pressure;
  const bool has_pressures = state.pressure.size() > 0;
  const Vector u = functions.nodal(c);

  const System truth = polyaffine::mixed_form(loaded_ventricle(full, wall_load(full, state.load)));
  Vector y(truth.size());
  y.head(u.size()) = u;
  if (has_pressures) y.tail(y.size() - u.size()) = check.space.pressures.transpose() * p;
  const Vector left = truth.residual({1, y}).values;

  const System system = polyaffine::mixed_form(loaded_ventricle(larger, wall_load(larger, state.load)));
  Vector at(system.size()), rest(system.size()), step;
  at.head(c.size()) = c;
  rest.head(c.size()) = -functions.transpose(left.head(u.size()));
  if (has_pressures) {
    at.tail(p.size()) = p;
    rest.tail(p.size()) = -check.space.pressures * left.tail(left.size() - u.size());
  }
  system.restrict(rest.head(c.size()));
  const auto linear = system.make_linear();
  polyaffine::Linearised tangent(system, *linear);
  if (!tangent.factorise({1, at}, 0) || !tangent.positive_definite() || !tangent.solve({1, at}, rest, step))
    return std::nullopt;
  const Vector volumes = node_volumes(functions.elements());
  const double size = displacement_size(volumes, u);
  return size > 0 ? check.factor * displacement_size(volumes, functions.nodal(step.head(c.size()))) / size
                  : 0;
}

}  // namespace cardiac
