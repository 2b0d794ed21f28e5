#include "polyaffine/geometry/polynomial_field.hpp"

#include <Eigen/Cholesky>

#include <polyaffine/core/error.hpp>

namespace polyaffine {

PolynomialField::PolynomialField(const Points& X, const Matrix& values, const Vector& weights, int degree)
    : degree_(degree) {
  const int n = (degree + 1) * (degree + 2) * (degree + 3) / 6;
  if (values.cols() != X.cols() || weights.size() != X.cols() || X.cols() < n)
    throw InputError("polynomial of degree " + std::to_string(degree) + ": found " +
                     std::to_string(X.cols()) + " points, " + std::to_string(values.cols()) + " values and " +
                     std::to_string(weights.size()) + " weights, expected as many of each, at least " +
                     std::to_string(n));
  const Vec3 low = X.rowwise().minCoeff();
  const Vec3 high = X.rowwise().maxCoeff();
  centre_ = (low + high) / 2;
  half_ = (high - low) / 2;
  if (!(half_.minCoeff() > 0)) throw InputError("polynomial: found points without extent in space");
  Matrix A = Matrix::Zero(n, n);
  Matrix rhs = Matrix::Zero(n, values.rows());
  Vector P;
  Eigen::MatrixX3d gradient;
  for (Eigen::Index q = 0; q < X.cols(); ++q) {
    functions(X.col(q), P, gradient);
    A.selfadjointView<Eigen::Lower>().rankUpdate(P, weights[q]);
    rhs += weights[q] * P * values.col(q).transpose();
  }
  // In a thin wall high degrees depend on each other; this holds their combinations that the wall does not
  // see.
  A.diagonal().array() += 1e-10 * weights.sum();
  coefficients_ = Eigen::LDLT<Matrix>(A).solve(rhs).transpose();
}

void PolynomialField::functions(const Vec3& X, Vector& P, Eigen::MatrixX3d& gradient) const {
  const Vec3 x = (X - centre_).cwiseQuotient(half_);
  Eigen::MatrixX3d L(degree_ + 1, 3), slope(degree_ + 1, 3);
  for (int k = 0; k < 3; ++k) {
    L(0, k) = 1;
    slope(0, k) = 0;
    for (int n = 0; n < degree_; ++n) {
      L(n + 1, k) = ((2 * n + 1) * x[k] * L(n, k) - (n > 0 ? n * L(n - 1, k) : 0)) / (n + 1);
      slope(n + 1, k) = (n > 0 ? slope(n - 1, k) : 0) + (2 * n + 1) * L(n, k) / half_[k];
    }
  }
  const int count = (degree_ + 1) * (degree_ + 2) * (degree_ + 3) / 6;
  P.resize(count);
  gradient.resize(count, 3);
  int m = 0;
  for (int i = 0; i <= degree_; ++i)
    for (int j = 0; i + j <= degree_; ++j)
      for (int k = 0; i + j + k <= degree_; ++k, ++m) {
        P[m] = L(i, 0) * L(j, 1) * L(k, 2);
        gradient(m, 0) = slope(i, 0) * L(j, 1) * L(k, 2);
        gradient(m, 1) = L(i, 0) * slope(j, 1) * L(k, 2);
        gradient(m, 2) = L(i, 0) * L(j, 1) * slope(k, 2);
      }
}

PolynomialField::Sample PolynomialField::sample(const Vec3& X) const {
  Vector P;
  Eigen::MatrixX3d gradient;
  functions(X, P, gradient);
  return {coefficients_ * P, coefficients_ * gradient};
}

}  // namespace polyaffine
