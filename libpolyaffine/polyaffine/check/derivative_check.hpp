#pragma once

#include <functional>
#include <vector>

#include <polyaffine/core/types.hpp>

namespace polyaffine {

struct DerivativeCheckOptions {
  /// Steps of the central differences, relative to max(1, ‖x‖∞).
  std::vector<double> steps = {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7};
  double tolerance = 1e-6;        ///< accepted relative error at the best step
  double zero_threshold = 1e-12;  ///< a derivative smaller than this times (1 + ‖f(x)‖∞) counts as zero
};

/// What the comparison found. A derivative that is zero passes nothing: agreement on zero proves nothing.
struct DerivativeReport {
  double relative_error = 0;  ///< ‖difference‖∞ / max(‖exact‖∞, ‖central difference‖∞) at the best step
  double best_step = 0;
  double magnitude = 0;  ///< largest entry of the derivative given
  int worst_row = 0;     ///< entry that differs most at the best step
  int worst_column = 0;
  bool is_zero = false;
  bool passed = false;  ///< error within the tolerance, finite, and not zero
};

/// Compares ∇f (n) with central differences (f(x + h e_j) − f(x − h e_j)) / 2h in every direction, over a
/// sweep of steps: the error first falls with h² and then rises with round-off; the best step counts.
DerivativeReport check_gradient(const std::function<double(const Vector&)>& value,
                                const std::function<Vector(const Vector&)>& gradient, const Vector& x,
                                const DerivativeCheckOptions& options = {});

/// The same for a function of several values: row i, column j of the matrix is ∂f_i/∂x_j. With f a gradient
/// the matrix is the Hessian.
DerivativeReport check_jacobian(const std::function<Vector(const Vector&)>& value,
                                const std::function<Matrix(const Vector&)>& jacobian, const Vector& x,
                                const DerivativeCheckOptions& options = {});

}  // namespace polyaffine
