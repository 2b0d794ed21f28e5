#pragma once

#include <polyaffine/core/types.hpp>
#include <polyaffine/material/batch.hpp>

namespace polyaffine {

/// A density over integration points: an energy W(F) per reference volume, or any other function of a 3×3
/// matrix carried by the point. Laws add up: a material is a list of them. Unit of W and P: kPa.
class Law {
 public:
  virtual ~Law() = default;
  /// Fills W, P = ∂W/∂F and, with `tangent`, the lower triangle of A = ∂²W/∂F² of one pack of points into a
  /// response that comes cleared. `points` are the places of the pack in the per-point data held by the law
  /// (fibres, stiffness) and in `state`. Values are meaningless, but finite work, where det F ≤ 0: callers
  /// check det F.
  virtual void respond(PackPoints points, const PackMotion& at, bool tangent, PackResponse& r) const = 0;
  /// Whether P depends on Ḟ; only such laws are shown it. They have no energy and add to a response that is
  /// not cleared.
  virtual bool feels_rate() const { return false; }
  /// Whether P comes from the state of the points (an active tension): what such a law gives is work that is
  /// done on the body, not energy that it stores.
  virtual bool feels_state() const { return false; }

  /// Adds W (1 number a point), P (9) and A (81, the 9×9 matrix ∂P_i/∂F_j) for `count` points from index
  /// `first` on. Matrices are stored column-major, one point after the other; the arrays start at the first
  /// point. Outputs that are null are skipped. Nothing moves (Ḟ = 0).
  void evaluate(int first, int count, const double* F, PointState state, double* W, double* P,
                double* A) const;
};

}  // namespace polyaffine
