#include "polyaffine/fields/polynomial_field.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <polyaffine/core/error.hpp>

namespace polyaffine {
namespace {

// Scattered points of a box from (1, −2, 0) to (4, 0, 10).
Points scattered(int n) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  Points X(3, n);
  for (int q = 0; q < n; ++q) X.col(q) = Vec3(1 + 3 * unit(random), -2 + 2 * unit(random), 10 * unit(random));
  return X;
}

template <class Field>
PolynomialField fit(const Points& X, const Field& field, int degree) {
  Matrix values(field(Vec3(X.col(0))).size(), X.cols());
  for (Eigen::Index q = 0; q < X.cols(); ++q) values.col(q) = field(Vec3(X.col(q)));
  return {X, values, Vector::Ones(X.cols()), degree};
}

Vector cubic(const Vec3& X) {
  Vector f(3);
  f << X.x() * X.y() * X.z(), X.z() * X.z() - 2, X.x() * X.x() * X.x();
  return f;
}

TEST(PolynomialField, PolynomialsOfItsDegreeAreExactWithTheirGradient) {
  const PolynomialField field = fit(scattered(200), cubic, 3);
  EXPECT_EQ(field.num_functions(), 20);
  const Vec3 X(2.5, -0.7, 3);
  const auto s = field.sample(X);
  EXPECT_LT((s.value - cubic(X)).norm(), 1e-7);
  Mat3 exact;
  exact << X.y() * X.z(), X.x() * X.z(), X.x() * X.y(), 0, 0, 2 * X.z(), 3 * X.x() * X.x(), 0, 0;
  EXPECT_LT((s.gradient - exact).norm(), 1e-7);
}

TEST(PolynomialField, NoiseIsDropped) {
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0, 0.1);
  const PolynomialField field = fit(
      scattered(4000), [&](const Vec3& X) { return Vector::Constant(1, X.z() + noise(random)); }, 2);
  const auto s = field.sample(Vec3(2, -1, 5));
  EXPECT_NEAR(s.value[0], 5, 0.02);  // 0.1 √(10 functions / 4000 points) = .005
  EXPECT_NEAR(s.gradient(0, 2), 1, 0.01);
}

TEST(PolynomialField, WeightsSayWhatCounts) {
  Points X = scattered(400);
  Matrix values = Matrix::Ones(1, 400);
  Vector weights = Vector::Ones(400);
  values.rightCols(200).setConstant(7);
  weights.tail(200).setZero();
  EXPECT_NEAR(PolynomialField(X, values, weights, 1).sample(Vec3(2, -1, 5)).value[0], 1, 1e-8);
}

TEST(PolynomialField, WhatCannotBeFittedIsRefused) {
  const Points X = scattered(9);
  EXPECT_THROW(PolynomialField(X, Matrix::Ones(1, 9), Vector::Ones(9), 2), InputError);  // ten functions
  EXPECT_THROW(PolynomialField(X, Matrix::Ones(1, 8), Vector::Ones(9), 1), InputError);
  Points flat = X;
  flat.row(2).setZero();
  EXPECT_THROW(PolynomialField(flat, Matrix::Ones(1, 9), Vector::Ones(9), 1), InputError);
}

}  // namespace
}  // namespace polyaffine
