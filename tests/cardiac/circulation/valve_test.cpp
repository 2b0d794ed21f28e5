#include <gtest/gtest.h>

#include <cardiac/circulation/valve.hpp>
#include <cmath>

namespace cardiac {
namespace {

const Valve valve{.resistance_kPa_ms_per_mm3 = 0.01 * resistance_per_mmHg_s_per_mL};

TEST(Valve, OpensLikeAResistanceAndClosesWithoutLeak) {
  const auto flow = [](double drop_mmHg, double resistance_mmHg_s_per_mL) {
    const Valve v{.resistance_kPa_ms_per_mm3 = resistance_mmHg_s_per_mL * resistance_per_mmHg_s_per_mL};
    return valve_flow(v, drop_mmHg * kPa_per_mmHg).flow_mm3_per_ms / flow_per_mL_per_s;
  };
  EXPECT_NEAR(flow(5, 0.01), 500, 1e-9);                     // 5 mmHg / 0.01
  EXPECT_NEAR(flow(0, 0.01), 5 * std::log(2.0), 1e-12);      // 0.05 ln 2 / 0.01
  EXPECT_NEAR(flow(-0.5, 0.01), 5 * std::exp(-10.0), 1e-7);  // ε/R e⁻¹⁰, to the second order of e⁻¹⁰
  EXPECT_LT(flow(-5, 1e-6), 1e-30);                          // however small the resistance
  EXPECT_EQ(flow(-1e8, 1e-6), 0);
}

TEST(Valve, FlowIsNeverNegativeAndNeverDecreases) {
  double last = 0;
  for (int i = -120; i <= 120; ++i) {
    const double drop = valve.smoothing_kPa * std::sinh(0.2 * i);  // up to ± 10⁸ kPa
    const ValveFlow q = valve_flow(valve, drop);
    EXPECT_GE(q.flow_mm3_per_ms, last) << drop;
    EXPECT_GE(q.slope, 0) << drop;
    if (drop > -700 * valve.smoothing_kPa) {
      EXPECT_GT(q.slope, 0) << drop;
      EXPECT_GT(q.flow_mm3_per_ms, last) << drop;
    }
    last = q.flow_mm3_per_ms;
  }
}

TEST(Valve, SlopeIsTheDerivative) {
  for (const double drop : {-0.1, -0.01, -1e-3, 0.0, 1e-3, 0.01, 1.0, 20.0}) {
    const double h = 1e-5 * valve.smoothing_kPa * (drop > 1 ? 100 : 1);
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
