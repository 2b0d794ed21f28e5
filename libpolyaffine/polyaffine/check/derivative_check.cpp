#include <algorithm>
#include <cmath>
#include <limits>

#include <polyaffine/check/derivative_check.hpp>
#include <polyaffine/core/error.hpp>

namespace polyaffine {

DerivativeReport check_jacobian(const std::function<Vector(const Vector&)>& value,
                                const std::function<Matrix(const Vector&)>& jacobian, const Vector& x,
                                const DerivativeCheckOptions& options) {
  const Matrix exact = jacobian(x);
  const Vector at_x = value(x);
  if (exact.rows() != at_x.size() || exact.cols() != x.size())
    throw ComputationError("derivative check: the derivative has the wrong number of rows or columns");

  DerivativeReport report;
  report.relative_error = std::numeric_limits<double>::infinity();
  report.magnitude = exact.cwiseAbs().maxCoeff();
  report.is_zero = !(report.magnitude > options.zero_threshold * (1 + at_x.cwiseAbs().maxCoeff()));
  Matrix difference(exact.rows(), exact.cols());
  for (const double relative_step : options.steps) {
    const double step = relative_step * std::max(1.0, x.cwiseAbs().maxCoeff());
    for (Eigen::Index j = 0; j < x.size(); ++j) {
      Vector forward = x, backward = x;
      forward[j] += step;
      backward[j] -= step;
      difference.col(j) = (value(forward) - value(backward)) / (forward[j] - backward[j]);
    }
    Eigen::Index row = 0, column = 0;
    const double worst = (difference - exact).cwiseAbs().maxCoeff(&row, &column);
    const double scale = std::max(report.magnitude, difference.cwiseAbs().maxCoeff());
    if (!exact.allFinite() || !difference.allFinite() || !(scale > 0)) continue;
    if (worst / scale < report.relative_error) {
      report.relative_error = worst / scale;
      report.best_step = step;
      report.worst_row = static_cast<int>(row);
      report.worst_column = static_cast<int>(column);
    }
  }
  report.passed = !report.is_zero && report.relative_error <= options.tolerance;
  return report;
}

DerivativeReport check_gradient(const std::function<double(const Vector&)>& value,
                                const std::function<Vector(const Vector&)>& gradient, const Vector& x,
                                const DerivativeCheckOptions& options) {
  return check_jacobian([&](const Vector& y) { return Vector::Constant(1, value(y)).eval(); },
                        [&](const Vector& y) { return Matrix(gradient(y).transpose()); }, x, options);
}

}  // namespace polyaffine
