#include <gtest/gtest.h>

#include <random>

#include <cardiac/heart/limit_cycle.hpp>

namespace cardiac {
namespace {

using polyaffine::Matrix;
using polyaffine::Vector;

/// Beats of the map x ↦ limit + A (x − limit) of the vessels, with one volume and a stroke volume that depend
/// on it linearly; noise is added to what a beat ends with.
std::vector<CycleBeat> beats_of(const Matrix& A, const Vector& limit, Vector x, int count, double noise = 0) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> even(-noise, noise);
  std::vector<CycleBeat> out;
  for (int n = 0; n < count; ++n) {
    Vector next = limit + A * (x - limit);
    for (double& value : next) value += even(random);
    CycleBeat beat{Vector(x.size() + 1), Vector(x.size() + 1), 70 - (x - limit).sum()};
    beat.start << 120 + 0.1 * (x - limit).sum(), x;
    beat.end << 120 + 0.1 * (next - limit).sum(), next;
    out.push_back(beat);
    x = next;
  }
  return out;
}

TEST(LimitCycle, OneVesselIsFoundFromTwoBeats) {
  const Vector limit = Vector::Constant(1, 12.0);
  for (const double ratio : {0.5, 0.92}) {
    const auto beats = beats_of(Matrix::Constant(1, 1, ratio), limit, Vector::Constant(1, 9.0), 2);
    const CycleEstimate estimate = estimate_limit_cycle(beats, 1);
    EXPECT_TRUE(estimate.extrapolated);
    EXPECT_NEAR(estimate.pressures_kPa[0], 12, 1e-9);
    // The last beat began at 12 − 3·ratio; two beats differ by (1 − ratio) of that.
    const double away = 3 * ratio, strokes = away / (70 + away), pressures = away / beats.back().end[1];
    EXPECT_NEAR(estimate.distance_percent, 100 * std::max(strokes, pressures), 1e-9);
  }
}

TEST(LimitCycle, ThreeVesselsAreFoundFromFourBeats) {
  Matrix A(3, 3);
  A << 0.9, 0.05, 0, 0.02, 0.6, 0.1, 0, 0.03, 0.3;
  const Vector limit = (Vector(3) << 12, 2, 1).finished();
  const auto beats = beats_of(A, limit, limit + (Vector(3) << 2, -0.5, 0.2).finished(), 4);
  const CycleEstimate estimate = estimate_limit_cycle(beats, 1);
  EXPECT_TRUE(estimate.extrapolated);
  // What is left comes of the direction in which the beats differ by less than noise.
  EXPECT_LT((estimate.pressures_kPa - limit).cwiseAbs().maxCoeff(), 0.02);
}

TEST(LimitCycle, AnEstimateFarOffIsNotUsed) {
  // One that does not come nearer at all, and one that runs away.
  for (const double ratio : {1.0, 1.3}) {
    const auto beats = beats_of(Matrix::Constant(1, 1, ratio), Vector::Constant(1, 12.0),
                                Vector::Constant(1, 11.9), 2, ratio == 1 ? 1e-3 : 0);
    const CycleEstimate estimate = estimate_limit_cycle(beats, 1);
    EXPECT_EQ(estimate.pressures_kPa[0], beats.back().end[1]) << ratio;
    EXPECT_FALSE(estimate.extrapolated) << ratio;
  }
  const auto one =
      beats_of(Matrix::Constant(1, 1, 0.5), Vector::Constant(1, 12.0), Vector::Constant(1, 9.0), 1);
  EXPECT_FALSE(estimate_limit_cycle(one, 1).extrapolated);
  EXPECT_GT(estimate_limit_cycle(one, 1).distance_percent, 100);
}

TEST(LimitCycle, NoiseIsToldFromSlowness) {
  const Vector limit = Vector::Constant(1, 12.0);
  const Matrix half = Matrix::Constant(1, 1, 0.5);
  EXPECT_TRUE(is_noise(beats_of(half, limit, Vector::Constant(1, 9.0), 16, 1e-3), 1));
  EXPECT_FALSE(is_noise(beats_of(half, limit, Vector::Constant(1, 9.0), 16), 1));
  EXPECT_FALSE(is_noise(beats_of(Matrix::Constant(1, 1, 0.97), limit, Vector::Constant(1, 9.0), 16), 1));
  EXPECT_FALSE(is_noise(beats_of(half, limit, Vector::Constant(1, 9.0), 3, 1e-3), 1));
}

}  // namespace
}  // namespace cardiac
