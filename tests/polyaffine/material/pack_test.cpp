#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <polyaffine/material/pack.hpp>

namespace polyaffine {
namespace {

TEST(Pack, ExponentialAgreesWithTheStandardLibrary) {
  for (double x = -700; x < 709; x += 0.3719) {
    const double exact = std::exp(x);
    EXPECT_NEAR(exp(broadcast(x))[0] / exact, 1, 4 * std::numeric_limits<double>::epsilon()) << x;
  }
  EXPECT_EQ(exp(broadcast(0))[0], 1);
}

TEST(Pack, ExponentialAtTheEndsOfItsRange) {
  EXPECT_EQ(exp(broadcast(1e4))[0], std::numeric_limits<double>::infinity());
  EXPECT_LT(exp(broadcast(-1e4))[0], 1e-300);
  EXPECT_GE(exp(broadcast(-1e4))[0], 0);
  EXPECT_TRUE(std::isnan(exp(broadcast(std::nan("")))[0]));
}

TEST(Pack, LanesAreIndependent) {
  Pack x;
  for (int lane = 0; lane < kLanes; ++lane) x[lane] = 0.5 + lane;
  for (int lane = 0; lane < kLanes; ++lane) {
    EXPECT_DOUBLE_EQ(exp(x)[lane], std::exp(0.5 + lane));
    EXPECT_DOUBLE_EQ(log(x)[lane], std::log(0.5 + lane));
    EXPECT_DOUBLE_EQ(cbrt(x)[lane], std::cbrt(0.5 + lane));
  }
}

TEST(Pack, GatherRepeatsTheLastPointAndScatterStopsThere) {
  const double in[] = {1, 0, 2};
  const Pack v = gather(in, 2, 2);
  for (int lane = 0; lane < kLanes; ++lane) EXPECT_EQ(v[lane], lane == 0 ? 1 : 2);
  double out[2 * kLanes] = {};
  scatter_add(out, 2, 1, v);
  EXPECT_EQ(out[0], 1);
  for (int i = 1; i < 2 * kLanes; ++i) EXPECT_EQ(out[i], 0);
}

}  // namespace
}  // namespace polyaffine
