#include <gtest/gtest.h>

#include <Eigen/QR>
#include <random>
#include <stdexcept>

#include <polyaffine/quadrature/nearest_weights.hpp>

#include "support/random_vector.hpp"

namespace polyaffine {
namespace {

constexpr int kPoints = 60;

// Six moments of points crowded towards x = 0, as if they were spread evenly over the unit square.
WeightConditions moments(int repeats = 1) {
  const Vector x = testing::random_vector(kPoints, 0.5, 1).array() + 0.5;
  const Vector y = testing::random_vector(kPoints, 0.5, 2).array() + 0.5;
  const Matrix xy = (Matrix(2, kPoints) << x.array().square().transpose(), y.transpose()).finished();
  WeightConditions out{Matrix(6 * repeats, kPoints), Vector(6 * repeats), Vector::Ones(6 * repeats)};
  for (int k = 0; k < repeats; ++k) {
    out.A.middleRows(6 * k, 6) << Matrix::Ones(1, kPoints), xy, xy.array().square().matrix(),
        xy.row(0).cwiseProduct(xy.row(1));
    out.b.segment(6 * k, 6) << 1, 0.5, 0.5, 1.0 / 3, 1.0 / 3, 0.25;
  }
  return out;
}

const Vector kUniform = Vector::Constant(kPoints, 1.0 / kPoints);

double distance(const Vector& w) {
  return ((w - kUniform).array().square() / kUniform.array()).sum();
}

TEST(NearestWeights, MeetTheConditionsAndAreTheNearest) {
  const WeightConditions c = moments();
  ASSERT_GT((c.A * kUniform - c.b).cwiseAbs().maxCoeff(), 0.05);
  for (const double least : {0.0, 0.2}) {
    const NearestWeights result = nearest_weights(c, kUniform, {.least = least});
    ASSERT_TRUE(result.met);
    EXPECT_LT((c.A * result.weights - c.b).cwiseAbs().maxCoeff(), 1e-13);
    const double lowest = least / kPoints * (1 + 1e-14);
    EXPECT_GE(result.weights.minCoeff(), least / kPoints * (1 - 1e-14));
    EXPECT_LE(result.weights.minCoeff(), lowest);  // some reach it: the bound matters
    // No step that keeps the conditions and the weights on the bound comes nearer.
    const Vector free = (result.weights.array() > lowest).cast<double>();
    const Matrix rows = c.A * free.asDiagonal();
    const Eigen::CompleteOrthogonalDecomposition<Matrix> solver(rows);
    for (unsigned seed = 10; seed < 60; ++seed) {
      Vector step = free.asDiagonal() * testing::random_vector(kPoints, 1e-4, seed);
      step -= solver.solve(rows * step);
      ASSERT_LT((c.A * step).norm(), 1e-16);
      EXPECT_GT(distance(result.weights + step), distance(result.weights));
    }
  }
}

TEST(NearestWeights, DoNotMindRepeatedConditions) {
  const NearestWeights once = nearest_weights(moments(), kUniform);
  const NearestWeights thrice = nearest_weights(moments(3), kUniform);
  ASSERT_TRUE(thrice.met);
  EXPECT_LT((once.weights - thrice.weights).norm(), 1e-12);
}

TEST(NearestWeights, LeaveWeightsAloneThatMeetTheConditions) {
  WeightConditions c = moments();
  c.b = c.A * kUniform;
  const NearestWeights result = nearest_weights(c, kUniform);
  EXPECT_EQ(result.iterations, 0);
  EXPECT_LT((result.weights - kUniform).norm(), 1e-16);
}

TEST(NearestWeights, SayWhenThereAreNone) {
  WeightConditions c = moments();
  c.b[1] = 1.2;  // the mean of x² outside the square
  const NearestWeights result = nearest_weights(c, kUniform);
  EXPECT_FALSE(result.met);
  EXPECT_GT(result.miss, 1e-3);
  WeightConditions against = moments(2);
  against.b[8] = 0.6;  // contradicts the condition it repeats
  EXPECT_FALSE(nearest_weights(against, kUniform).met);
}

TEST(NearestWeights, RejectWrongInput) {
  EXPECT_THROW(nearest_weights(moments(), Vector::Ones(3)), std::invalid_argument);
  EXPECT_THROW(nearest_weights(moments(), Vector::Zero(kPoints)), std::invalid_argument);
}

}  // namespace
}  // namespace polyaffine
