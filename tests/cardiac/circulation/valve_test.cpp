#include <gtest/gtest.h>

#include <cardiac/circulation/valve.hpp>
#include <cmath>

namespace cardiac {
namespace {

const Valve valve{.resistance_kPa_ms_per_mm3 = 0.01 * resistance_per_mmHg_s_per_mL};

TEST(Valve, OpensLikeAResistanceAndClosesWithoutLeak) {
  const double open = valve_flow(valve, 5 * kPa_per_mmHg).flow_mm3_per_ms / flow_per_mL_per_s;
  EXPECT_NEAR(open, 500, 0.02);  // 5 mmHg / 0.01; the rest is ε²/(4RΔp) = 0.0125 mL/s
  const double closed = valve_flow(valve, -100 * kPa_per_mmHg).flow_mm3_per_ms / flow_per_mL_per_s;
  EXPECT_NEAR(closed, 6.25e-4, 1e-9);  // 0.05² / (4 · 0.01 · 100)
  const double balanced = valve_flow(valve, 0).flow_mm3_per_ms / flow_per_mL_per_s;
  EXPECT_NEAR(balanced, 2.5, 1e-12);  // 0.05 / (2 · 0.01)
}

TEST(Valve, LeaksNoMoreForwardHoweverSmallItsResistance) {
  for (const double resistance : {1e-3, 1e-6}) {
    const Valve small{.resistance_kPa_ms_per_mm3 = resistance * resistance_per_mmHg_s_per_mL};
    const double closed = valve_flow(small, -100 * kPa_per_mmHg).flow_mm3_per_ms / flow_per_mL_per_s;
    EXPECT_NEAR(closed, 6.25e-4, 1e-9);
    const double open = valve_flow(small, 5 * kPa_per_mmHg).flow_mm3_per_ms / flow_per_mL_per_s;
    EXPECT_NEAR(open * resistance, 5, 2e-4);  // ε²/(4Δp) = 1.25e-4 mmHg and less
  }
}

TEST(Valve, FlowIsPositiveAndIncreasing) {
  double last = 0;
  for (int i = -120; i <= 120; ++i) {
    const double drop = valve.smoothing_kPa * std::sinh(0.2 * i);  // up to ± 10⁸ kPa
    const ValveFlow q = valve_flow(valve, drop);
    EXPECT_GT(q.flow_mm3_per_ms, last) << drop;
    EXPECT_GT(q.slope, 0) << drop;
    last = q.flow_mm3_per_ms;
  }
}

TEST(Valve, SlopeIsTheDerivative) {
  for (const double drop : {-20.0, -1.0, -0.01, -1e-3, 0.0, 1e-3, 0.01, 1.0, 20.0}) {
    const double h = 1e-5 * std::max(std::abs(drop), valve.smoothing_kPa);
    const double difference =
        (valve_flow(valve, drop + h).flow_mm3_per_ms - valve_flow(valve, drop - h).flow_mm3_per_ms) / (2 * h);
    const double slope = valve_flow(valve, drop).slope;
    EXPECT_NEAR(slope / difference, 1, 1e-8) << drop;  // h² and rounding/h, both relative, at h = 1e-5
  }
}

TEST(Valve, LeaksBackwardsThroughItsLeakOnly) {
  Valve leaking = valve;
  leaking.leak_kPa_ms_per_mm3 = 50 * valve.resistance_kPa_ms_per_mm3;
  const auto flow = [&](double drop_mmHg) {
    return valve_flow(leaking, drop_mmHg * kPa_per_mmHg).flow_mm3_per_ms / flow_per_mL_per_s;
  };
  EXPECT_NEAR(flow(5), 500, 0.02);
  EXPECT_NEAR(flow(-80), -160, 0.02);  // 80 mmHg / 0.5
  const double h = 1e-6;
  for (const double drop : {-10.0, -0.005, 0.0, 0.01, 3.0})
    EXPECT_NEAR(
        valve_flow(leaking, drop).slope * 2 * h /
            (valve_flow(leaking, drop + h).flow_mm3_per_ms - valve_flow(leaking, drop - h).flow_mm3_per_ms),
        1, 1e-6)
        << drop;
}

TEST(Valve, CountsAsOpenUntilThePressureReallyTurns) {
  EXPECT_TRUE(is_open(valve, 1));
  EXPECT_TRUE(is_open(valve, -0.4 * kPa_per_mmHg));
  EXPECT_FALSE(is_open(valve, -0.6 * kPa_per_mmHg));
}

}  // namespace
}  // namespace cardiac
