#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include <polyaffine/kinematics/linear_blend.hpp>

namespace polyaffine {
namespace {

Matrix random_matrix(int rows, int cols, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  return Matrix::NullaryExpr(rows, cols, [&] { return normal(random); });
}

Matrix partition_of_unity(int n, int m) {
  Matrix weights = random_matrix(n, m, 1).cwiseAbs();
  return weights * weights.colwise().sum().cwiseInverse().asDiagonal();
}

TEST(LinearBlend, ForcesAreTheTransposeOfPositions) {
  const Matrix weights = partition_of_unity(5, 40);
  const Points x = 30 * random_matrix(3, 40, 2), force = random_matrix(3, 40, 3),
               rate = random_matrix(3, 20, 4);
  const double power = force.cwiseProduct(blend_positions(weights, rate, x)).sum();
  const double reduced = blend_forces(weights, x, force).cwiseProduct(rate).sum();
  EXPECT_GT(std::abs(power), 1);
  EXPECT_NEAR(power, reduced, 1e-13 * force.norm() * rate.norm() * x.norm());
}

TEST(LinearBlend, TheTranslationColumnIsTheWeightedResultant) {
  const Matrix weights = partition_of_unity(3, 10);
  const Points x = random_matrix(3, 10, 2), force = random_matrix(3, 10, 3);
  const Points reduced = blend_forces(weights, x, force);
  for (int i = 0; i < 3; ++i)
    EXPECT_LT((reduced.col(4 * i + 3) - force * weights.row(i).transpose()).norm(), 1e-13);
}

TEST(LinearBlend, EqualFramesGiveTheirAffineMap) {
  const Points x = random_matrix(3, 10, 2);
  const Eigen::Matrix<double, 3, 4> frame = random_matrix(3, 4, 5);
  const Points moved = blend_positions(partition_of_unity(6, 10), frame.replicate(1, 6), x);
  EXPECT_LT((moved - ((frame.leftCols<3>() * x).colwise() + frame.col(3))).norm(), 1e-13);
}

TEST(LinearBlend, GradientMatchesFiniteDifferences) {
  const Points frames = random_matrix(3, 8, 6);
  const Vec3 slope(0.3, -0.2, 0.5);
  const auto weights = [&](const Vec3& x) {
    return Vector(Eigen::Vector2d(std::sin(slope.dot(x)), 1 - std::sin(slope.dot(x))));
  };
  const Vec3 x(0.4, 1.2, -0.7);
  Points gradients(3, 2);
  gradients << std::cos(slope.dot(x)) * slope, -std::cos(slope.dot(x)) * slope;
  const Mat3 f = blend_gradient(weights(x), gradients, frames, x);
  for (int k = 0; k < 3; ++k) {
    const Vec3 h = 1e-5 * Vec3::Unit(k);  // central difference: error of order 1e-10
    const Vec3 difference =
        (blend_positions(weights(x + h), frames, x + h) - blend_positions(weights(x - h), frames, x - h)) /
        2e-5;
    EXPECT_LT((f.col(k) - difference).norm(), 1e-8);
    EXPECT_GT(difference.norm(), 0.01);
  }
}

TEST(LinearBlend, RejectsDifferentSizes) {
  EXPECT_THROW(blend_positions(Matrix::Ones(2, 3), Points::Ones(3, 4), Points::Ones(3, 3)),
               std::invalid_argument);
  EXPECT_THROW(blend_forces(Matrix::Ones(2, 3), Points::Ones(3, 3), Points::Ones(3, 2)),
               std::invalid_argument);
}

}  // namespace
}  // namespace polyaffine
