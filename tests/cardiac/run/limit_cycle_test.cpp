#include <gtest/gtest.h>

#include <random>
#include <utility>

#include <cardiac/run/limit_cycle.hpp>

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

TEST(LimitCycle, ASlowVesselBehindAFastOneIsNotTakenForClose) {
  // The fast one hides the slow one, which comes nearer by a tenth a beat: the distance told is not far
  // below.
  Matrix A(2, 2);
  A << 0.9, 0.05, 0.02, 0.5;
  const Vector limit = (Vector(2) << 12, 2).finished();
  const auto beats = beats_of(A, limit, limit + (Vector(2) << 2, -0.5).finished(), 8);
  for (std::ptrdiff_t n = 2; n <= 8; ++n) {
    const CycleEstimate estimate = estimate_limit_cycle({beats.begin(), beats.begin() + n}, 1);
    const Vector left = (beats[n - 1].start.tail(2) - limit).cwiseQuotient(limit).cwiseAbs();
    EXPECT_GT(estimate.distance_percent, 50 * left.maxCoeff()) << n;
  }
}

TEST(LimitCycle, BeatsThatBeginWithTheEstimateComeThereFast) {
  // As a heart does it; the slowest of the three comes nearer by 8 % a beat of its own.
  Matrix A(3, 3);
  A << 0.92, 0.05, 0, 0.02, 0.6, 0.1, 0, 0.03, 0.3;
  const Vector limit = (Vector(3) << 12, 2, 1).finished();
  Vector x = limit + (Vector(3) << 3, -0.5, 0.2).finished();
  std::vector<CycleBeat> beats;
  double told = 0, left = 0;
  for (int n = 0; n < 8; ++n) {
    beats.push_back(beats_of(A, limit, x, 1).front());
    const CycleEstimate estimate = estimate_limit_cycle(beats, 1);
    told = estimate.distance_percent / 100;
    left = (x - limit).cwiseQuotient(limit).cwiseAbs().maxCoeff();
    if (n > 0) {
      EXPECT_LT(left, 2 * told + 1e-12) << n;
    }
    x = estimate.pressures_kPa;
  }
  EXPECT_LT(left, 1e-3);  // 3/12 · 0.92⁷ = 0.14 without
}

TEST(LimitCycle, AnEstimateFarOffIsNotUsed) {
  // 200 differences away; more than half of the pressure off; and a single beat.
  for (const auto& [ratio, begin] : {std::pair{0.995, 11.0}, std::pair{0.9, 40.0}}) {
    const auto beats =
        beats_of(Matrix::Constant(1, 1, ratio), Vector::Constant(1, 12.0), Vector::Constant(1, begin), 2);
    const CycleEstimate estimate = estimate_limit_cycle(beats, 1);
    EXPECT_FALSE(estimate.extrapolated) << ratio;
    EXPECT_EQ(estimate.pressures_kPa[0], beats.back().end[1]) << ratio;
    EXPECT_GT(estimate.distance_percent, 1) << ratio;
  }
}

TEST(LimitCycle, NoiseIsToldFromSlowness) {
  const auto noisy_from = [](double ratio, double noise) {
    const auto beats = beats_of(Matrix::Constant(1, 1, ratio), Vector::Constant(1, 12.0),
                                Vector::Constant(1, 9.0), 30, noise);
    for (int n = 1; n <= 30; ++n)
      if (is_noise({beats.begin(), beats.begin() + n}, 1)) return n;
    return 0;
  };
  // The noise is a 3000th of the first distance, which halving beats reach after 12.
  EXPECT_GT(noisy_from(0.5, 1e-3), 8);
  EXPECT_EQ(noisy_from(0.5, 0), 0);
  EXPECT_EQ(noisy_from(0.97, 0), 0);
}

// Residuals that only change their sign are noise, but of many vessels not before the extrapolation had beats
// enough to learn from.
TEST(LimitCycle, FewBeatsOfManyVesselsAreNoNoise) {
  const auto noisy_from = [](int vessels) {
    std::vector<CycleBeat> beats;
    for (int n = 1; n <= 30; ++n) {
      const Vector start = Vector::Constant(1 + vessels, 10);
      beats.push_back({start, start + Vector::Constant(1 + vessels, n % 2 == 0 ? 0.01 : -0.01), 70});
      if (is_noise(beats, 1)) return n;
    }
    return 0;
  };
  EXPECT_EQ(noisy_from(1), 5);
  EXPECT_EQ(noisy_from(4), 5);
  EXPECT_EQ(noisy_from(6), 7);
  EXPECT_EQ(noisy_from(0), 0);
}

}  // namespace
}  // namespace cardiac
