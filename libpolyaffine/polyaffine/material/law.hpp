#pragma once

#include <span>

#include <polyaffine/core/types.hpp>

namespace polyaffine {

/// One scalar of state per integration point (an active tension in kPa, for instance); empty when there is
/// none.
using PointState = std::span<const double>;

/// A density over integration points: an energy W(F) per reference volume, or any other function of a 3×3
/// matrix carried by the point. Laws add up: a material is a list of them.
///
/// Matrices are stored column-major, one point after the other: F and P have 9 numbers a point, A = ∂²W/∂F²
/// has 81 (the 9×9 matrix ∂P_i/∂F_j). Unit of W and P: kPa.
class Law {
 public:
  virtual ~Law() = default;
  /// Adds W (1 number a point), P = ∂W/∂F and A for `count` points, the first of which has index `first` in
  /// the per-point data held by the law (fibres, stiffness) and in `state`; the arrays start at that point.
  /// Outputs that are null are skipped. Values are meaningless, but finite work, where det F ≤ 0: callers
  /// check det F.
  virtual void evaluate(int first, int count, const double* F, PointState state, double* W, double* P,
                        double* A) const = 0;
};

}  // namespace polyaffine
