#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include <polyaffine/quadrature/nnls.hpp>

namespace polyaffine {
namespace {

Matrix random_matrix(int rows, int cols, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return Matrix::NullaryExpr(rows, cols, [&] { return normal(random); });
}

// Karush–Kuhn–Tucker: x ≥ 0, Aᵀ(b − Ax) ≤ 0, and = 0 where x > 0.
void expect_optimal(const Matrix& a, const Vector& b, const NnlsResult& result) {
  ASSERT_TRUE(result.converged);
  EXPECT_GE(result.x.minCoeff(), 0);
  const Vector residual = b - a * result.x;
  EXPECT_NEAR(residual.norm(), result.residual, 1e-12 * b.norm());
  const Vector gradient = a.transpose() * residual;
  const double rounding = 1e-11 * a.norm() * b.norm();  // products of a few hundred terms
  EXPECT_LT(gradient.maxCoeff(), rounding);
  EXPECT_LT(gradient.cwiseProduct(result.x).cwiseAbs().maxCoeff(), rounding * (1 + result.x.maxCoeff()));
}

TEST(Nnls, KnownSolutions) {
  Matrix a(2, 2);
  a << 1, 0, 0, 2;
  EXPECT_LT((nnls(a, Vec4(3, 4, 0, 0).head<2>()).x - Eigen::Vector2d(3, 2)).norm(), 1e-14);
  EXPECT_LT((nnls(a, Eigen::Vector2d(3, -4)).x - Eigen::Vector2d(3, 0)).norm(), 1e-14);
  const NnlsResult none = nnls(a, Eigen::Vector2d(-3, -4));
  EXPECT_EQ(none.x.norm(), 0);
  EXPECT_NEAR(none.residual, 5, 1e-14);
  EXPECT_TRUE(none.converged);
}

TEST(Nnls, IsOptimalForRandomTallWideAndDependentProblems) {
  std::mt19937_64 random(7);
  for (int trial = 0; trial < 20; ++trial) {
    const Matrix tall = random_matrix(40, 15, random);
    const Matrix wide = random_matrix(15, 60, random);
    Matrix dependent = random_matrix(30, 40, random);
    dependent.rightCols(20) = dependent.leftCols(20) * random_matrix(20, 20, random);
    dependent.col(3).setZero();
    for (const Matrix& a : {tall, wide, dependent}) {
      const Vector b = random_matrix(static_cast<int>(a.rows()), 1, random);
      expect_optimal(a, b, nnls(a, b));
    }
  }
}

TEST(Nnls, ScalesOfColumnsDoNotMatter) {
  std::mt19937_64 random(8);
  const Matrix a = random_matrix(30, 50, random);
  const Vector b = random_matrix(30, 1, random);
  const Vector scale = Vector::LinSpaced(50, -8, 8).unaryExpr([](double e) { return std::pow(10.0, e); });
  const Vector x = nnls(a, b).x;
  const Vector y = scale.asDiagonal() * nnls(a * scale.asDiagonal(), b).x;
  EXPECT_GT(x.norm(), 0.1);
  EXPECT_LT((x - y).norm(), 1e-10 * x.norm());
}

TEST(Nnls, FindsAnExactRepresentationInALargeProblem) {
  std::mt19937_64 random(9);
  const Matrix a = random_matrix(200, 2000, random);
  const Vector positive = random_matrix(2000, 1, random).cwiseAbs();
  const Vector b = a * positive;
  const NnlsResult result = nnls(a, b);
  EXPECT_LT(result.residual, 1e-11 * b.norm());
  EXPECT_LE((result.x.array() > 0).count(), 200);
}

TEST(Nnls, RejectsWrongSizesAndNumbers) {
  EXPECT_THROW(nnls(Matrix::Ones(2, 3), Vector::Ones(3)), std::invalid_argument);
  EXPECT_THROW(nnls(Matrix::Constant(2, 3, std::nan("")), Vector::Ones(2)), std::invalid_argument);
}

TEST(Nnls, SaysWhenItStopsEarly) {
  std::mt19937_64 random(10);
  const Matrix a = random_matrix(30, 50, random);
  NnlsOptions options;
  options.max_iterations = 2;
  EXPECT_FALSE(nnls(a, a * Vector::Ones(50), options).converged);
}

}  // namespace
}  // namespace polyaffine
