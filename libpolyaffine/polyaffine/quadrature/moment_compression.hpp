#pragma once

#include <vector>

#include <polyaffine/core/types.hpp>

namespace polyaffine {

/// A few of the candidate points with new weights.
struct CompressedRule {
  std::vector<int> points;  ///< candidate indices, ascending
  Vector weights;           ///< > 0, in the order of `points`
  /// Largest error of a moment, relative to Σ_j |F_ij| w_j of its row.
  double residual = 0;
};

/// Positive weights on at most m of n candidate points that keep the m moments F w (Tchakaloff's theorem):
/// F (m × n) holds the moment functions at the candidates, w ≥ 0 (n) their weights. The moment functions are
/// made orthonormal under w, so they may be badly scaled or dependent; then NNLS finds the sparse weights
/// (Sommariva and Vianello 2015). Include the constant function to keep Σ w.
/// Throws std::invalid_argument when sizes differ or a weight is negative, ComputationError when a moment
/// is missed by more than `tolerance` (relative, as in CompressedRule::residual).
CompressedRule compress_moments(const Matrix& features, const Vector& weights, double tolerance = 1e-10);

}  // namespace polyaffine
