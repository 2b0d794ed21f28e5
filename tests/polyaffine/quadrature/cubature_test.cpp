#include "polyaffine/quadrature/cubature.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace polyaffine {
namespace {

// Integrals over [0, 1] of e^{−λx} for many λ between 0 and 6, on a midpoint rule of 400 points: a family of
// functions that few points integrate, though no few polynomials span it exactly.
constexpr int kPoints = 400;
double midpoint(int j) {
  return (j + 0.5) / kPoints;
}
Matrix terms(const Vector& lambda) {
  Matrix out(lambda.size(), kPoints);
  for (Eigen::Index i = 0; i < lambda.size(); ++i)
    for (int j = 0; j < kPoints; ++j) out(i, j) = std::exp(-lambda[i] * midpoint(j)) / kPoints;
  return out;
}
Vector exact(const Vector& lambda) {
  return lambda.unaryExpr([](double l) { return l == 0 ? 1 : (1 - std::exp(-l)) / l; });
}
double sum(const CompressedRule& rule, const Matrix& A, Eigen::Index row) {
  return A(row, rule.points).dot(rule.weights);
}

CompressedRule trained(const Vector& lambda, double accuracy) {
  CubatureTraining training(kPoints);
  for (Eigen::Index i = 0; i < lambda.size(); ++i) {  // one state after the other
    const Vector own = lambda.segment(i, 1), target = exact(own);
    const Matrix A = terms(own);
    Matrix dual(1, kPoints + 1);
    dual << A, target;
    training.add(A, target, dual);
  }
  return training.select(accuracy);
}

TEST(Cubature, FewPointsWithPositiveFactorsForUntrainedStatesToo) {
  const CompressedRule rule = trained(Vector::LinSpaced(30, 0, 6), 1e-6);
  EXPECT_LE(rule.points.size(), 8u);
  EXPECT_GT(rule.weights.minCoeff(), 0);
  EXPECT_LE(rule.residual, 1e-6);
  const Vector between = Vector::LinSpaced(7, 0.15, 5.9);
  const Matrix A = terms(between);
  for (Eigen::Index i = 0; i < between.size(); ++i) EXPECT_NEAR(sum(rule, A, i), exact(between)[i], 1e-5);
}

TEST(Cubature, LessAccuracyNeedsFewerPoints) {
  std::size_t before = kPoints;
  for (const double accuracy : {1e-6, 1e-3, 1e-1}) {
    const CompressedRule rule = trained(Vector::LinSpaced(30, 0, 6), accuracy);
    EXPECT_LE(rule.residual, accuracy * (1 + 1e-6));
    EXPECT_LT(rule.points.size(), before);
    before = rule.points.size();
  }
}

// Two integrals, one of which does not count: one point keeps the other.
TEST(Cubature, ErrorsAreThoseOfTheNorm) {
  const Vector lambda = Eigen::Vector2d(0, 6), target = exact(lambda);
  const Matrix A = terms(lambda);
  for (const Eigen::Index kept : {0, 1}) {
    Matrix N = Matrix::Zero(2, 2), data(2, kPoints + 1);
    N(kept, kept) = 1;
    data << A, target;
    CubatureTraining training(kPoints);
    training.add(A, target, N * data);
    const CompressedRule rule = training.select(2e-3);
    ASSERT_EQ(rule.points.size(), 1u);
    EXPECT_NEAR(sum(rule, A, kept), target[kept], 2e-3);
    EXPECT_GT(std::abs(sum(rule, A, 1 - kept) - target[1 - kept]), 0.05);
  }
}

}  // namespace
}  // namespace polyaffine
