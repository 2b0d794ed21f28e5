#pragma once

#include <functional>
#include <memory>

#include <polyaffine/linear/projection.hpp>
#include <polyaffine/system/term.hpp>

namespace polyaffine {

/// The equation Σ_terms R(t, y, ẏ) = 0 over the blocks of a layout, with fixed unknowns of the field, c_i =
/// t · prescribed_i, functions that slide in a plane, n·c_a = 0, or linear constraints C c = t d by
/// projection (not together with either). All that Newton's method, load stepping and time integration know.
struct System {
  StateLayout layout;
  Terms terms;
  std::vector<char> fixed = {};                       ///< by unknown of the field; empty: none
  Vector prescribed = {};                             ///< by unknown of the field, used where fixed; empty: 0
  std::shared_ptr<const Projection> projection = {};  ///< null: no linear constraints
  HeldDirections held = {};  ///< functions of the field that slide; not together with a projection

  /// Makes the LinearSystem of the field; empty: dense_system, or projected_system with a projection.
  std::function<std::unique_ptr<LinearSystem>(const System&)> linear = {};

  int size() const { return layout.size(); }
  Residual residual(const At& at) const;
  /// Moves the unknowns of the field to where the constraints have them at t.
  void prescribe(double t, Vector& y) const;
  /// Keeps of a force on the field what the constraints let act.
  void restrict(Eigen::Ref<Vector> force) const;
  std::unique_ptr<LinearSystem> make_linear() const;
};

/// A system of a field alone, "displacement" in mm; the tolerance is that of time integration.
System field_system(int num_unknowns, Terms terms = {}, std::vector<char> fixed = {},
                    double tolerance_mm = 0);

/// The mixed form: pressures are unknowns where terms have them. The terms of the other are shared.
System mixed_form(const System& system);

}  // namespace polyaffine
