#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <stdexcept>

#include <polyaffine/quadrature/moment_compression.hpp>

namespace polyaffine {
namespace {

// Monomials to a total degree at points in a box of side `size` (mm), unscaled.
Matrix monomials(const Points& x, int degree) {
  std::vector<Vector> rows;
  for (int i = 0; i <= degree; ++i)
    for (int j = 0; i + j <= degree; ++j)
      for (int k = 0; i + j + k <= degree; ++k)
        rows.emplace_back((x.row(0).array().pow(i) * x.row(1).array().pow(j) * x.row(2).array().pow(k))
                              .matrix()
                              .transpose());
  Matrix features(rows.size(), x.cols());
  for (size_t i = 0; i < rows.size(); ++i) features.row(i) = rows[i].transpose();
  return features;
}

struct Cloud {
  Points points;
  Vector weights;
};

Cloud random_cloud(int n, double size, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(0.1, 1);
  Cloud cloud;
  cloud.points = Points::NullaryExpr(3, n, [&] { return size * uniform(random); });
  cloud.weights = Vector::NullaryExpr(n, [&] { return uniform(random); });
  return cloud;
}

TEST(CompressMoments, KeepsAllMomentsWithAtMostAsManyPoints) {
  const Cloud cloud = random_cloud(3000, 30, 3);
  for (const int degree : {1, 2, 4, 6}) {
    const Matrix features = monomials(cloud.points, degree);
    const CompressedRule rule = compress_moments(features, cloud.weights);
    EXPECT_LE(rule.weights.size(), features.rows());
    EXPECT_EQ(rule.weights.size(), static_cast<Eigen::Index>(rule.points.size()));
    EXPECT_GT(rule.weights.minCoeff(), 0);
    EXPECT_TRUE(std::is_sorted(rule.points.begin(), rule.points.end()));
    const Vector before = features * cloud.weights;
    const Vector after = features(Eigen::all, rule.points) * rule.weights;
    // All monomials are positive here, so the moments themselves are the scale.
    EXPECT_LT(((after - before).array() / before.array()).abs().maxCoeff(), 1e-11) << degree;
    EXPECT_NEAR(rule.residual, ((after - before).array() / before.array()).abs().maxCoeff(), 1e-14);
  }
}

TEST(CompressMoments, DependentFeaturesNeedNoExtraPoints) {
  const Cloud cloud = random_cloud(500, 1, 4);
  const Matrix features = monomials(cloud.points, 2);
  Matrix twice(20, 500);
  twice << features, 1e6 * features;
  const CompressedRule rule = compress_moments(twice, cloud.weights);
  EXPECT_LE(rule.points.size(), 10u);
  EXPECT_LT(rule.residual, 1e-11);
}

TEST(CompressMoments, LeavesOutPointsWithoutWeightAndKeepsASmallSet) {
  Cloud cloud = random_cloud(4, 1, 5);
  cloud.weights[2] = 0;
  const CompressedRule rule = compress_moments(monomials(cloud.points, 2), cloud.weights);
  EXPECT_EQ(rule.points, (std::vector<int>{0, 1, 3}));
  EXPECT_NEAR(rule.weights[2], cloud.weights[3], 1e-10);
}

TEST(CompressMoments, RejectsWrongInput) {
  EXPECT_THROW(compress_moments(Matrix::Ones(2, 3), Vector::Ones(2)), std::invalid_argument);
  EXPECT_THROW(compress_moments(Matrix::Ones(2, 3), -Vector::Ones(3)), std::invalid_argument);
}

}  // namespace
}  // namespace polyaffine
