#include <gtest/gtest.h>

#include <cmath>

#include <polyaffine/rules/split_rule.hpp>

namespace polyaffine {
namespace {

constexpr int kPartDegree = 2;
constexpr double kBorder = 0.37;  // of the first barycentric coordinate; no midpoint of any level

template <class Corners>
bool crossed(const Corners& corners) {
  return corners.row(0).minCoeff() < kBorder && corners.row(0).maxCoeff() > kBorder;
}

TetRule tet(int levels) {
  return split_rule(tet_rule(4), tet_rule(kPartDegree), crossed<Eigen::Matrix4d>, levels);
}

TriangleRule triangle(int levels) {
  return split_rule(triangle_rule(4), triangle_rule(kPartDegree), crossed<Mat3>, levels);
}

template <class Rule>
double share_above(const Rule& rule) {
  return (rule.barycentric.row(0).transpose().array() > kBorder).select(rule.weights, 0).sum();
}

template <class Rule>
void expect_exact(const Rule& rule, int corners) {
  EXPECT_GT(rule.weights.minCoeff(), 0);
  EXPECT_GT(rule.barycentric.minCoeff(), 0);
  EXPECT_NEAR(rule.weights.sum(), 1, 1e-14);
  EXPECT_LT((rule.barycentric.colwise().sum().array() - 1).abs().maxCoeff(), 1e-14);
  // Mean of λ_i λ_j over a simplex with n corners: (1 + δ_ij)/(n (n + 1)).
  const Matrix second = rule.barycentric * rule.weights.asDiagonal() * rule.barycentric.transpose();
  for (int i = 0; i < corners; ++i)
    for (int j = 0; j < corners; ++j)
      EXPECT_NEAR(second(i, j), (i == j ? 2.0 : 1.0) / (corners * (corners + 1)), 1e-14);
}

TEST(SplitRule, PartsCoverTheElementOnceAndKeepTheirDegree) {
  for (const int levels : {1, 2, 3}) {
    expect_exact(tet(levels), 4);
    expect_exact(triangle(levels), 3);
  }
}

TEST(SplitRule, LeavesAnElementWholeThatNoBorderCrosses) {
  const auto nowhere = [](const Eigen::Matrix4d&) { return false; };
  EXPECT_EQ(split_rule(tet_rule(4), tet_rule(2), nowhere, 3).weights, tet_rule(4).weights);
  EXPECT_EQ(tet(0).weights, tet_rule(4).weights);
}

TEST(SplitRule, CutsOnlyWhatTheBorderCrosses) {
  const Eigen::Index part = tet_rule(kPartDegree).weights.size();
  EXPECT_EQ(tet(1).weights.size(), 8 * part);
  EXPECT_LT(tet(2).weights.size(), 64 * part);
  EXPECT_GT(tet(2).weights.size(), 8 * part);
}

// Of a simplex of dimension d, (1 − b)^d lies where λ_0 > b.
TEST(SplitRule, FindsTheShareOnEachSideOfABorder) {
  const double volume = std::pow(1 - kBorder, 3), area = std::pow(1 - kBorder, 2);
  EXPECT_GT(std::abs(share_above(tet(0)) - volume), 0.02);
  EXPECT_LT(std::abs(share_above(tet(3)) - volume), 0.01);
  EXPECT_GT(std::abs(share_above(triangle(0)) - area), 0.02);
  EXPECT_LT(std::abs(share_above(triangle(3)) - area), 0.01);
}

}  // namespace
}  // namespace polyaffine
