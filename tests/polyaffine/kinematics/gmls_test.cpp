#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>
#include <stdexcept>

#include <polyaffine/core/error.hpp>
#include <polyaffine/kinematics/gmls.hpp>

namespace polyaffine {
namespace {

struct Cloud {
  Points nodes;
  double length = 15;  // mm

  explicit Cloud(int n) {
    std::mt19937_64 random(17);
    std::uniform_real_distribution<double> uniform(-30, 30);
    nodes = Points::NullaryExpr(3, n, [&] { return uniform(random); }).colwise() + Vec3(100, -40, 20);
  }

  // Gaussian weights, not normalised.
  GmlsValues at(const Vec3& x) const {
    const Points d = (-nodes).colwise() + x;
    const Vector w = (-d.colwise().squaredNorm() / (2 * 20.0 * 20.0)).array().exp().transpose();
    const Points gradients = -d * w.asDiagonal() / (20.0 * 20.0);
    return gmls_functions(x, nodes, w, gradients, length);
  }
};

const Vec3 kPoint(95, -30, 17);

class GmlsNodes : public testing::TestWithParam<int> {};

TEST_P(GmlsNodes, ReproduceEveryAffineMap) {
  const Cloud cloud(GetParam());
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  const Mat3 a = Mat3::NullaryExpr([&] { return normal(random); });
  const Vec3 t(3, -2, 7);
  Points coefficients(3, 4 * GetParam());
  for (int i = 0; i < GetParam(); ++i) {
    coefficients.col(4 * i) = a * cloud.nodes.col(i) + t;
    coefficients.middleCols<3>(4 * i + 1) = cloud.length * a;
  }
  const GmlsValues shape = cloud.at(kPoint);
  const Vec3 exact = a * kPoint + t;
  EXPECT_LT((coefficients * shape.values - exact).norm(), 1e-12 * exact.norm());
  // Gradients cancel sums over 4n functions of size 1/length times positions of 100 mm.
  EXPECT_LT((coefficients * shape.gradients.transpose() - a).norm(), 1e-11 * a.norm());
}

TEST_P(GmlsNodes, GradientsMatchFiniteDifferences) {
  const Cloud cloud(GetParam());
  const GmlsValues shape = cloud.at(kPoint);
  for (int k = 0; k < 3; ++k) {
    constexpr double kStep = 1e-3;  // mm, against lengths of 20: central differences good to 1e-9
    const Vec3 h = kStep * Vec3::Unit(k);
    const Vector difference = (cloud.at(kPoint + h).values - cloud.at(kPoint - h).values) / (2 * kStep);
    EXPECT_LT((difference - shape.gradients.row(k).transpose()).norm(), 1e-8);
    EXPECT_GT(difference.norm(), 1e-3);
  }
}

// One and three nodes do not span space: the derivative functions keep the moment matrix regular.
INSTANTIATE_TEST_SUITE_P(OneThreeAndMany, GmlsNodes, testing::Values(1, 3, 17));

// The closed formula written out with the origin at zero.
TEST(Gmls, MatchesTheFormula) {
  const Cloud cloud(5);
  const Points d = (-cloud.nodes).colwise() + kPoint;
  const Vector w = (-d.colwise().squaredNorm() / 800.0).array().exp().transpose();
  const auto p = [&](const Vec3& x) { return Vec4(1, x[0] / 15, x[1] / 15, x[2] / 15); };
  Eigen::Matrix4d m = Eigen::Matrix4d::Zero();
  for (int i = 0; i < 5; ++i) {
    const Vec4 q = p(cloud.nodes.col(i));
    m += w[i] * (q * q.transpose() + Eigen::Matrix4d(Vec4(0, 1, 1, 1).asDiagonal()));
  }
  const Vec4 g = m.inverse() * p(kPoint);
  const GmlsValues shape = cloud.at(kPoint);
  for (int i = 0; i < 5; ++i) {
    EXPECT_NEAR(shape.values[4 * i], w[i] * g.dot(p(cloud.nodes.col(i))), 1e-12);
    for (int k = 1; k < 4; ++k) EXPECT_NEAR(shape.values[4 * i + k], w[i] * g[k], 1e-12);
  }
}

TEST(Gmls, RejectsVanishingWeightsAndWrongSizes) {
  EXPECT_THROW(gmls_functions(kPoint, Points::Zero(3, 2), Vector::Zero(2), Points::Zero(3, 2), 1),
               ComputationError);
  EXPECT_THROW(gmls_functions(kPoint, Points::Zero(3, 2), Vector::Ones(3), Points::Zero(3, 2), 1),
               std::invalid_argument);
}

}  // namespace
}  // namespace polyaffine
