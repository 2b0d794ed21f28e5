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

TEST(Valve, OfAStenosisLosesByTheSquareOfItsFlow) {
  Valve narrow = valve;
  narrow.stenosis_kPa_ms2_per_mm6 = 4e-4 * stenosis_per_mmHg_s2_per_mL2;  // an orifice of 1 cm²
  const double q = valve_flow(narrow, 40 * kPa_per_mmHg).flow_mm3_per_ms / flow_per_mL_per_s;
  EXPECT_NEAR(0.01 * q + 4e-4 * q * q, 40, 1e-4);
  EXPECT_NEAR(q, 303.97, 0.01);  // by hand: (√(0.01² + 4 · 4e-4 · 40) − 0.01) / (2 · 4e-4)
  const double closed = valve_flow(narrow, -100 * kPa_per_mmHg).flow_mm3_per_ms / flow_per_mL_per_s;
  EXPECT_NEAR(closed, 6.25e-4, 1e-7);
}

TEST(Valve, SlopesOfEveryLawAreDerivatives) {
  Valve narrow = valve, arctan = valve, tanh = valve;
  narrow.stenosis_kPa_ms2_per_mm6 = 1e-3 * stenosis_per_mmHg_s2_per_mL2;
  narrow.leak_kPa_ms_per_mm3 = 100 * valve.resistance_kPa_ms_per_mm3;
  for (Valve* law : {&arctan, &tanh}) {
    law->leak_kPa_ms_per_mm3 = 1e4 * valve.resistance_kPa_ms_per_mm3;
    law->sharpness_per_kPa = 5 / kPa_per_mmHg;
  }
  arctan.law = ValveLaw::arctan;
  tanh.law = ValveLaw::tanh;
  for (const Valve& law : {narrow, arctan, tanh})
    for (const double drop : {-5.0, -0.05, -1e-3, 1e-3, 0.02, 3.0}) {
      const double h = 1e-6;
      const double difference =
          (valve_flow(law, drop + h).flow_mm3_per_ms - valve_flow(law, drop - h).flow_mm3_per_ms) / (2 * h);
      EXPECT_NEAR(valve_flow(law, drop).slope / difference, 1, 2e-6) << drop;
    }
}

TEST(Valve, OtherLawsAreOpenAndClosedResistances) {
  Valve law = valve;
  law.leak_kPa_ms_per_mm3 = 1e6 * valve.resistance_kPa_ms_per_mm3;
  law.sharpness_per_kPa = 200 / kPa_per_mmHg;
  for (const ValveLaw kind : {ValveLaw::arctan, ValveLaw::tanh}) {
    law.law = kind;
    const double slack = kind == ValveLaw::tanh ? 1e-9 : 0.02;  // log R is 1e-3 of its range off
    EXPECT_NEAR(valve_flow(law, 2).flow_mm3_per_ms * law.resistance_kPa_ms_per_mm3, 2, 2 * slack);
    EXPECT_NEAR(valve_flow(law, -2).flow_mm3_per_ms * law.leak_kPa_ms_per_mm3, -2, 2 * slack);
  }
}

TEST(Valve, DropOfAFlowIsResistanceForwardsAndLeakBackwards) {
  Valve law = valve;
  law.leak_kPa_ms_per_mm3 = 1e5 * valve.resistance_kPa_ms_per_mm3;
  law.stenosis_kPa_ms2_per_mm6 = 1e-4 * stenosis_per_mmHg_s2_per_mL2;
  const auto drop = [&](double q) { return valve_drop(law, q * flow_per_mL_per_s).drop_kPa / kPa_per_mmHg; };
  EXPECT_NEAR(drop(200), 0.01 * 200 + 1e-4 * 200 * 200, 1e-3);
  EXPECT_NEAR(drop(-1), -1000, 0.1);  // 1 mL/s through 1000 mmHg·s/mL; δ²/4q is 6e-5 mL/s
  for (const double q : {-3.0, -0.01, 0.001, 0.3, 100.0}) {
    const double h = 1e-6 * std::max(std::abs(q), 0.1);
    const double difference = (valve_drop(law, q + h).drop_kPa - valve_drop(law, q - h).drop_kPa) / (2 * h);
    EXPECT_NEAR(valve_drop(law, q).slope / difference, 1, 1e-5) << q;
  }
}

}  // namespace
}  // namespace cardiac
