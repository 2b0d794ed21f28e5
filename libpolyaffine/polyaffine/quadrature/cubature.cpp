#include "polyaffine/quadrature/cubature.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <vector>

#include <polyaffine/quadrature/nnls.hpp>

namespace polyaffine {
namespace {

// Rows A and right-hand side b with AᵀA = G and Aᵀb = h, but for what is below `negligible` of the diagonal:
// Cholesky's factor, its pivots taken in the order of their size.
struct Rows {
  Matrix A;
  Vector b;
};
Rows least_squares_rows(const Matrix& G, const Vector& h, double negligible) {
  const Eigen::Index n = G.rows();
  Vector rest = G.diagonal();
  const double smallest = negligible * rest.maxCoeff();
  Matrix columns(n, n);  // of Aᵀ
  Vector b(n);
  Eigen::Index rank = 0;
  for (Eigen::Index pivot = 0; rank < n && rest.maxCoeff(&pivot) > smallest; ++rank) {
    const double root = std::sqrt(rest[pivot]);
    auto column = columns.col(rank);
    column = G.col(pivot);
    column.noalias() -= columns.leftCols(rank) * columns.row(pivot).head(rank).transpose();
    column /= root;
    b[rank] = (h[pivot] - columns.row(pivot).head(rank).dot(b.head(rank))) / root;
    rest -= column.cwiseAbs2();
    rest[pivot] = 0;
  }
  return {columns.leftCols(rank).transpose(), b.head(rank)};
}

}  // namespace

CubatureTraining::CubatureTraining(Eigen::Index candidates)
    : gram_(Matrix::Zero(candidates, candidates)), products_(Vector::Zero(candidates)) {}

void CubatureTraining::add(const Matrix& contributions, const Vector& target, const Matrix& dual) {
  const auto n = contributions.cols();
  gram_.triangularView<Eigen::Lower>() += contributions.transpose() * dual.leftCols(n);
  products_.noalias() += contributions.transpose() * dual.col(n);
  norm_ += target.dot(dual.col(n));
}

CompressedRule CubatureTraining::select(double accuracy) const {
  constexpr double kNegligible = 1e-12;  // far below what an accuracy of 10⁻⁴ can see
  const Matrix G = gram_.selfadjointView<Eigen::Lower>();
  const auto [A, b] = least_squares_rows(G, products_, kNegligible);
  const double unreachable = std::max(0.0, norm_ - b.squaredNorm());
  const double wanted = std::sqrt(std::max(0.0, accuracy * accuracy * norm_ - unreachable));
  const Vector x = nnls(A, b, {.accuracy = wanted / b.norm()}).x;
  CompressedRule rule;
  for (Eigen::Index j = 0; j < x.size(); ++j)
    if (x[j] > 0) rule.points.push_back(static_cast<int>(j));
  rule.weights = x(rule.points);
  rule.residual = std::sqrt(std::max(0.0, norm_ - 2 * products_.dot(x) + x.dot(G * x)) / norm_);
  return rule;
}

}  // namespace polyaffine
