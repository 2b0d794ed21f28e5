#pragma once

#include <polyaffine/core/types.hpp>

namespace polyaffine {

struct NnlsOptions {
  /// Stop when ‖b − Ax‖ ≤ tolerance·‖b‖, or when no column (scaled to length one) has a product with the
  /// residual above tolerance·‖b‖.
  double tolerance = 1e-14;
  double accuracy = 0;  ///< stop when ‖b − Ax‖ ≤ accuracy·‖b‖, with few columns instead of the minimum
  int max_iterations = 0;  ///< columns entered or left; 0 stands for 10 × (rows + 1) + columns
};

struct NnlsResult {
  Vector x;             ///< ≥ 0; the columns of A with x > 0 are linearly independent
  double residual = 0;  ///< ‖b − Ax‖
  int iterations = 0;
  bool converged = false;  ///< the optimality conditions hold within the tolerance
};

/// min ‖Ax − b‖ subject to x ≥ 0 (A: m × n, b: m) by the active-set method of Lawson and Hanson (1974), on a
/// QR factorisation of the active columns that is updated as columns enter and leave: O(mn) an iteration.
/// Throws std::invalid_argument when the sizes differ or a number is not finite.
NnlsResult nnls(const Matrix& a, const Vector& b, const NnlsOptions& options = {});

}  // namespace polyaffine
