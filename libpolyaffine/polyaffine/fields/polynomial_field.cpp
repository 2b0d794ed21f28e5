#include "polyaffine/fields/polynomial_field.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>

#include <polyaffine/core/error.hpp>

namespace polyaffine {
namespace {

constexpr Eigen::Index kBlock = 256;  // points summed at a time

constexpr int count_of(int degree) {
  return (degree + 1) * (degree + 2) * (degree + 3) / 6;
}

}  // namespace

PolynomialField::PolynomialField(const Points& X, const Matrix& values, const Vector& weights, int degree)
    : degree_(degree) {
  if (degree < 0 || degree > kMostDegree)
    throw InputError("polynomial: found the degree " + std::to_string(degree) + ", expected 0 to " +
                     std::to_string(kMostDegree));
  const int n = count_of(degree);
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
  Matrix block(n, kBlock);
  for (Eigen::Index first = 0; first < X.cols(); first += kBlock) {
    const Eigen::Index count = std::min(kBlock, X.cols() - first);
    for (Eigen::Index k = 0; k < count; ++k) block.col(k) = functions(X.col(first + k)).row(0);
    const auto P = block.leftCols(count);
    const Matrix weighted = P * weights.segment(first, count).asDiagonal();
    A.noalias() += weighted * P.transpose();
    rhs.noalias() += weighted * values.middleCols(first, count).transpose();
  }
  // In a thin wall high degrees depend on each other; this holds their combinations that the wall does not
  // see.
  A.diagonal().array() += 1e-10 * weights.sum();
  coefficients_ = Eigen::LDLT<Matrix>(A).solve(rhs).transpose();
}

bool PolynomialField::is_whole() const {
  return degree_ >= 0 && degree_ <= kMostDegree && coefficients_.cols() == count_of(degree_);
}

PolynomialField::Functions PolynomialField::functions(const Vec3& X) const {
  const Vec3 x = (X - centre_).cwiseQuotient(half_);
  std::array<std::array<double, kMostDegree + 1>, 3> L, slope;
  for (int k = 0; k < 3; ++k) {
    L[k][0] = 1;
    slope[k][0] = 0;
    for (int n = 0; n < degree_; ++n) {
      L[k][n + 1] = ((2 * n + 1) * x[k] * L[k][n] - (n > 0 ? n * L[k][n - 1] : 0)) / (n + 1);
      slope[k][n + 1] = (n > 0 ? slope[k][n - 1] : 0) + (2 * n + 1) * L[k][n] / half_[k];
    }
  }
  Functions out(4, count_of(degree_));
  int m = 0;
  for (int i = 0; i <= degree_; ++i)
    for (int j = 0; i + j <= degree_; ++j)
      for (int k = 0; i + j + k <= degree_; ++k, ++m) {
        out.col(m) << L[0][i] * L[1][j] * L[2][k], slope[0][i] * L[1][j] * L[2][k],
            L[0][i] * slope[1][j] * L[2][k], L[0][i] * L[1][j] * slope[2][k];
      }
  return out;
}

PolynomialField::Sample PolynomialField::sample(const Vec3& X) const {
  const Functions f = functions(X);
  if (coefficients_.rows() != 3)
    return {coefficients_ * f.row(0).transpose(), coefficients_ * f.bottomRows<3>().transpose()};
  // A vector field is asked for at every point of a wall: all twelve sums at once, without memory of their
  // own.
  Eigen::Matrix<double, 4, 3> sums = Eigen::Matrix<double, 4, 3>::Zero();
  for (Eigen::Index m = 0; m < f.cols(); ++m) {
    const Vec4 function = f.col(m);
    for (int i = 0; i < 3; ++i) sums.col(i) += coefficients_(i, m) * function;
  }
  return {sums.row(0).transpose(), sums.bottomRows<3>().transpose()};
}

}  // namespace polyaffine
