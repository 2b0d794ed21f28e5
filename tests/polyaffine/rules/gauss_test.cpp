#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

#include <polyaffine/rules/gauss.hpp>

namespace polyaffine {
namespace {

double factorial(int n) {
  return std::tgamma(n + 1.0);
}

// The nodes are given to 16 digits and each sum has at most 24 terms of order one.
constexpr double kRounding = 2e-15;

TEST(TetRule, IsExactForEveryMonomialPositiveAndInside) {
  for (int degree = 1; degree <= 6; ++degree) {
    const TetRule rule = tet_rule(degree);
    EXPECT_GT(rule.weights.minCoeff(), 0);
    EXPECT_GT(rule.barycentric.minCoeff(), 0);
    EXPECT_LT((rule.barycentric.colwise().sum().array() - 1).abs().maxCoeff(), kRounding);
    for (int i = 0; i <= degree; ++i)
      for (int j = 0; i + j <= degree; ++j)
        for (int k = 0; i + j + k <= degree; ++k) {
          double sum = 0;
          for (Eigen::Index q = 0; q < rule.weights.size(); ++q)
            sum += rule.weights[q] * std::pow(rule.barycentric(1, q), i) *
                   std::pow(rule.barycentric(2, q), j) * std::pow(rule.barycentric(3, q), k);
          const double exact = 6 * factorial(i) * factorial(j) * factorial(k) / factorial(i + j + k + 3);
          EXPECT_NEAR(sum, exact, kRounding) << "degree " << degree << " x^" << i << " y^" << j << " z^" << k;
        }
  }
}

TEST(TetRule, IsNotExactBeyondItsDegree) {
  const TetRule rule = tet_rule(6);
  const double sum = rule.weights.dot(rule.barycentric.row(0).transpose().array().pow(8).matrix());
  const double exact = 6 * factorial(8) / factorial(11);
  EXPECT_GT(std::abs(sum / exact - 1), 1e-4);  // so the test of exactness above can fail
}

TEST(TriangleRule, IsExactForEveryMonomialPositiveAndInside) {
  for (int degree = 1; degree <= 6; ++degree) {
    const TriangleRule rule = triangle_rule(degree);
    EXPECT_GT(rule.weights.minCoeff(), 0);
    EXPECT_GT(rule.barycentric.minCoeff(), 0);
    for (int i = 0; i <= degree; ++i)
      for (int j = 0; i + j <= degree; ++j) {
        double sum = 0;
        for (Eigen::Index q = 0; q < rule.weights.size(); ++q)
          sum += rule.weights[q] * std::pow(rule.barycentric(1, q), i) * std::pow(rule.barycentric(2, q), j);
        EXPECT_NEAR(sum, 2 * factorial(i) * factorial(j) / factorial(i + j + 2), kRounding)
            << "degree " << degree << " x^" << i << " y^" << j;
      }
  }
}

TEST(LineRule, IsExactToTwiceItsPointsAndAscending) {
  for (int n = 1; n <= 12; ++n) {
    const LineRule rule = line_rule(n);
    EXPECT_GT(rule.weights.minCoeff(), 0);
    EXPECT_GT(rule.points[0], 0);
    EXPECT_LT(rule.points[n - 1], 1);
    for (int i = 1; i < n; ++i) EXPECT_GT(rule.points[i], rule.points[i - 1]);
    for (int p = 0; p <= 2 * n - 1; ++p)
      EXPECT_NEAR(rule.weights.dot(rule.points.array().pow(p).matrix()), 1.0 / (p + 1), kRounding)
          << n << " " << p;
  }
}

TEST(Rules, RejectUnknownDegrees) {
  EXPECT_THROW(tet_rule(0), std::invalid_argument);
  EXPECT_THROW(tet_rule(7), std::invalid_argument);
  EXPECT_THROW(triangle_rule(7), std::invalid_argument);
  EXPECT_THROW(line_rule(0), std::invalid_argument);
}

TEST(GaussPoints, IntegrateOverAMesh) {
  Points p(3, 5);
  p << 0, 2, 0, 0, 2,  //
      0, 0, 3, 0, 3,   //
      0, 0, 0, 1, 1;
  Tets tets(4, 2);
  tets << 0, 1,  //
      1, 2,      //
      2, 3,      //
      3, 4;
  if ((p.col(2) - p.col(1)).cross(p.col(3) - p.col(1)).dot(p.col(4) - p.col(1)) < 0)
    std::swap(tets(0, 1), tets(1, 1));
  const TetMesh mesh(p, tets);
  const QuadraturePoints q = gauss_points(mesh, 2);
  ASSERT_EQ(q.size(), 8);
  EXPECT_NEAR(q.weights.sum(), mesh.volume(), 1e-14 * mesh.volume());
  const Points x = positions(mesh, q);
  const Vec3 moment = x * q.weights;
  const Vec3 exact = mesh.tet_volume(0) * mesh.tet_centroid(0) + mesh.tet_volume(1) * mesh.tet_centroid(1);
  EXPECT_LT((moment - exact).norm(), 1e-14 * exact.norm());
  const Vector heights = interpolate(mesh, mesh.points().row(2).transpose(), q);
  EXPECT_LT((heights - x.row(2).transpose()).norm(), 1e-14);
}

}  // namespace
}  // namespace polyaffine
