#include <gtest/gtest.h>

#include <cardiac/core/given_curve.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace cardiac {
namespace {

TEST(GivenCurve, IsConstantBeforeAndBehindItsSamples) {
  const GivenCurve curve = GivenCurve::through({10, 20, 40}, {1, 3, 2});
  EXPECT_DOUBLE_EQ(curve.at(20).first, 3);
  EXPECT_DOUBLE_EQ(curve.at(0).first, 1);
  EXPECT_DOUBLE_EQ(curve.at(99).first, 2);
  EXPECT_DOUBLE_EQ(curve.at(99).second, 0);
}

// A period of a cosine, with its last value again at the end or without it.
TEST(GivenCurve, RepeatsWithoutAKinkAtTheJoint) {
  for (const bool whole : {true, false}) {
    std::vector<double> times, values;
    for (int i = 0; i < (whole ? 81 : 80); ++i) {
      times.push_back(10 * i);
      values.push_back(5 + 2 * std::cos(2 * std::numbers::pi * i / 80));
    }
    const GivenCurve curve = GivenCurve::through(times, values, 800);
    EXPECT_DOUBLE_EQ(curve.period_ms(), 800);
    for (const double t : {3.0, 203.0, 399.0, 797.0})
      for (const double beat : {-1.0, 0.0, 5.0})
        EXPECT_NEAR(curve.at(t + 800 * beat).first, 5 + 2 * std::cos(2 * std::numbers::pi * t / 800), 2e-3)
            << t;
    const double h = 1e-4;
    EXPECT_NEAR(curve.at(800 - h).second, curve.at(800 + h).second, 1e-6);
  }
}

TEST(GivenCurve, RateIsTheDerivative) {
  const GivenCurve curve = GivenCurve::through({0, 100, 250, 600}, {1, 8, 4, 3}, 800);
  for (const double t : {40.0, 130.0, 500.0, 700.0}) {
    const double h = 1e-3, difference = (curve.at(t + h).first - curve.at(t - h).first) / (2 * h);
    EXPECT_NEAR(curve.at(t).second, difference, 1e-7);
    EXPECT_GT(std::abs(difference), 1e-4);
  }
}

TEST(GivenCurve, RefusesWhatIsNoCurve) {
  EXPECT_THROW(GivenCurve::through({0}, {1}), std::invalid_argument);
  EXPECT_THROW(GivenCurve::through({0, 5, 5}, {1, 2, 3}), std::invalid_argument);
  EXPECT_THROW(GivenCurve::through({0, 900}, {1, 2}, 800), std::invalid_argument);
}

}  // namespace
}  // namespace cardiac
