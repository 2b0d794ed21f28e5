#pragma once

#include <cstddef>
#include <deque>

#include <polyaffine/core/types.hpp>

namespace polyaffine {

/// Anderson's acceleration of the fixed-point iteration x ← x + f(x): from the last x on, the step f − (ΔX +
/// ΔF) γ with γ = argmin ‖f − ΔF γ‖, the columns of ΔX and ΔF being the differences of the last points and of
/// their f. A linear f of n unknowns is zero after n + 1 of them. Source: Walker and Ni 2011.
class Anderson {
 public:
  /// Looks back on so many points before the last one.
  explicit Anderson(std::size_t memory) : memory_(memory) {}

  /// Takes in a point and its f; the step from it. Differences that depend on others to 1e-6 are left out.
  Vector step(const Vector& x, const Vector& f);
  void forget();

 private:
  std::size_t memory_;
  std::deque<Vector> x_, f_;
};

}  // namespace polyaffine
