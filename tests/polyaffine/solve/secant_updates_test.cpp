#include "polyaffine/solve/secant_updates.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include "support/random_vector.hpp"

namespace polyaffine {
namespace {

using testing::random_vector;

// Newton's method on b − K x with the inverse of a tangent that differs from K in two directions of eight.
class StaleTangent : public ::testing::Test {
 protected:
  static constexpr int kSize = 8;
  Matrix K = Matrix::Identity(kSize, kSize) + 0.3 * random_vector(kSize * kSize, 1, 1).reshaped(kSize, kSize);
  Matrix change =
      random_vector(kSize * 2, 1, 2).reshaped(kSize, 2) * random_vector(2 * kSize, 0.3, 3).reshaped(2, kSize);
  Matrix stale = (K + change).inverse();
  Vector weights = Vector::LinSpaced(kSize, 1, 3);
  SecantUpdates updates;

  // Iterations until the residual is below 10⁻¹² of the first one.
  int iterations(const Vector& b, bool learn) {
    Vector x = Vector::Zero(kSize), r = b;
    updates.restart();
    for (int k = 1; k < 100; ++k) {
      Vector step = stale * r;
      if (learn) updates.improve(weights, step);
      x += step;
      r = b - K * x;
      if (r.norm() < 1e-12 * b.norm()) return k;
    }
    return 100;
  }
};

TEST_F(StaleTangent, TwoUnknownDirectionsAreLearntAndKept) {
  const Vector b = random_vector(kSize, 1, 4), other = random_vector(kSize, 1, 5);
  EXPECT_GT(iterations(b, false), 20);
  const int first = iterations(b, true);
  EXPECT_LE(first, 8);
  EXPECT_LE(iterations(other, true), first);  // another right-hand side with what was learnt
}

TEST_F(StaleTangent, ClearForgetsAndTheFirstStepIsPlain) {
  iterations(random_vector(kSize, 1, 4), true);
  updates.clear();
  const Vector r = random_vector(kSize, 1, 5);
  Vector step = stale * r;
  updates.improve(weights, step);
  EXPECT_EQ(step, Vector(stale * r));
}

}  // namespace
}  // namespace polyaffine
