#include "cardiac/validation/oscillation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace cardiac {
namespace {

using polyaffine::kPi;
using polyaffine::Vector;

TEST(Oscillation, FindsAWaveOnASmoothTrend) {
  const Vector s = Vector::LinSpaced(200, 0.2, 0.9);
  Vector y(200);
  for (int k = 0; k < 200; ++k)
    y[k] = 3 - 2 * s[k] + 5 * std::pow(s[k], 4) + 0.03 * std::cos(2 * kPi * s[k] / 0.15 + 0.7);
  EXPECT_NEAR(oscillation(s, y, 0.15, 4), 0.03, 1e-12);
  EXPECT_GT(oscillation(s, y, 0.15, 0), 0.04);         // the trend passes for a wave
  EXPECT_LT(oscillation(s, y, 0.15 / 2.5, 4), 0.003);  // the wave has another length
}

TEST(Oscillation, IsNothingOnAPolynomial) {
  const Vector s = Vector::LinSpaced(50, -1, 3);
  const Vector y = 2 + 3 * s.array() - s.array().cube();
  EXPECT_LT(oscillation(s, y, 0.8, 3), 1e-12);
}

TEST(Oscillation, RefusesWhatCannotBeFitted) {
  const Vector s = Vector::LinSpaced(5, 0, 1);
  EXPECT_THROW(oscillation(s, Vector::Zero(4), 0.5, 1), std::invalid_argument);
  EXPECT_THROW(oscillation(s, s, 0, 1), std::invalid_argument);
  EXPECT_THROW(oscillation(s, s, 0.5, 3), std::invalid_argument);
}

}  // namespace
}  // namespace cardiac
