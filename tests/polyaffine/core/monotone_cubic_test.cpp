#include "polyaffine/core/monotone_cubic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

namespace polyaffine {
namespace {

TEST(MonotoneCubic, PassesThroughItsPointsWithoutOvershoot) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int repeat = 0; repeat < 20; ++repeat) {
    std::vector<double> x{0}, y{0};
    for (int k = 0; k < 12; ++k) {
      x.push_back(x.back() + 0.05 + uniform(random));
      y.push_back(std::pow(uniform(random), 4) * (k % 3 == 0 ? -1 : 1));  // steep, with flat stretches
    }
    const MonotoneCubic f(x, y);
    for (std::size_t k = 0; k + 1 < x.size(); ++k) {
      EXPECT_NEAR(f(x[k]).first, y[k], 1e-14);
      // The first and last interval take the slope of their chord at the end and are monotone as well.
      const double low = std::min(y[k], y[k + 1]) - 1e-14;
      const double high = std::max(y[k], y[k + 1]) + 1e-14;
      const double sign = y[k + 1] >= y[k] ? 1 : -1;
      for (int i = 1; i < 50; ++i) {
        const auto [value, slope] = f(x[k] + i / 50.0 * (x[k + 1] - x[k]));
        EXPECT_GE(value, low);
        EXPECT_LE(value, high);
        EXPECT_GE(sign * slope, -1e-13);
      }
    }
  }
}

TEST(MonotoneCubic, ReproducesLinesAndContinuesStraight) {
  const std::vector<double> x{-1, 0, 0.1, 2, 5};
  std::vector<double> y;
  for (const double at : x) y.push_back(3 - 2 * at);
  const MonotoneCubic f(x, y);
  for (const double at : {-4.0, -1.0, -0.3, 0.05, 1.7, 5.0, 9.0}) {
    EXPECT_NEAR(f(at).first, 3 - 2 * at, 1e-13);
    EXPECT_NEAR(f(at).second, -2, 1e-13);
  }
  const MonotoneCubic bent({0, 1, 2}, {0, 1, 4});
  const auto [end, slope] = bent(2);
  EXPECT_NEAR(bent(3).first, end + slope, 1e-14);
  EXPECT_NEAR(bent(3).second, slope, 1e-14);
}

TEST(MonotoneCubic, SlopeIsTheDerivativeAndContinuous) {
  const MonotoneCubic f({0, 0.7, 1, 2.5, 3}, {0, 0.2, 1.5, 1.6, 4});
  for (double x = -0.195; x < 3.2; x += 0.05) {
    constexpr double kStep = 1e-5;
    // Central differences: h² times a third derivative below 10³.
    EXPECT_NEAR(f(x).second, (f(x + kStep).first - f(x - kStep).first) / (2 * kStep), 1e-6);
  }
  for (const double knot : {0.0, 0.7, 1.0, 2.5, 3.0})
    EXPECT_NEAR(f(knot - 1e-10).second, f(knot + 1e-10).second, 1e-7);
}

TEST(MonotoneCubic, ConvergesOnASmoothMonotoneFunction) {
  const auto error = [](int n) {
    std::vector<double> x, y;
    for (int k = 0; k <= n; ++k) {
      x.push_back(2.0 * k / n);
      y.push_back(std::exp(x.back()));
    }
    const MonotoneCubic f(x, y);
    double worst = 0;  // away from the ends, whose slopes are of first order
    for (double at = 0.5; at <= 1.5; at += 0.003)
      worst = std::max(worst, std::abs(f(at).first - std::exp(at)));
    return worst;
  };
  // The harmonic mean of chord slopes is a slope of second order, its cubic of third.
  EXPECT_NEAR(std::log2(error(20) / error(40)), 3, 0.3);
  EXPECT_NEAR(std::log2(error(40) / error(80)), 3, 0.3);
}

TEST(MonotoneCubic, BadPointsAreRefused) {
  EXPECT_THROW(MonotoneCubic({1}, {1}), std::invalid_argument);
  EXPECT_THROW(MonotoneCubic({1, 2}, {1}), std::invalid_argument);
  EXPECT_THROW(MonotoneCubic({1, 1}, {1, 2}), std::invalid_argument);
  EXPECT_THROW(MonotoneCubic({2, 1}, {1, 2}), std::invalid_argument);
}

}  // namespace
}  // namespace polyaffine
