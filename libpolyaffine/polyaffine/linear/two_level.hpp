#pragma once

#include <Eigen/SparseCore>
#include <optional>

#include <polyaffine/core/types.hpp>

namespace polyaffine {

/// Iterations of solve_two_level and the residual they reached, ‖b − A x‖ / ‖b‖.
struct TwoLevelReport {
  int iterations = 0;
  double residual = 0;
};

/// A x = b with A symmetric positive definite (both triangles stored, n × n) by conjugate gradients. The
/// preconditioner is one sweep of Gauss–Seidel, a correction in the space of the columns of P (n × coarse,
/// Pᵀ A P solved by sparse Cholesky), and the sweep backwards (Briggs, Henson and McCormick 2000, ch. 5).
/// With P the linear functions among the quadratic ones the number of iterations hardly depends on the mesh,
/// so that work and memory grow with it, but for the small system of P. Empty when Pᵀ A P or a diagonal entry
/// is not positive or the residual does not fall below `tolerance` within `most_iterations`.
std::optional<Vector> solve_two_level(const Eigen::SparseMatrix<double>& A,
                                      const Eigen::SparseMatrix<double>& P, const Vector& b, double tolerance,
                                      int most_iterations, TwoLevelReport* report = nullptr);

}  // namespace polyaffine
