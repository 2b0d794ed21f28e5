#include "cardiac/circulation/two_sided_loop.hpp"

#include <gtest/gtest.h>

#include <cardiac/core/units.hpp>

namespace cardiac {
namespace {

using polyaffine::Matrix;
using polyaffine::Vector;

TwoSidedLoop loop() {
  TwoSidedLoop out;
  out.left = {{0.01 * resistance_per_mmHg_s_per_mL},
              {0.007 * resistance_per_mmHg_s_per_mL},
              {0.04 * resistance_per_mmHg_s_per_mL, resistance_per_mmHg_s_per_mL,
               1.3 * compliance_per_mL_per_mmHg, 0},
              16 * compliance_per_mL_per_mmHg};
  out.right = {{0.02 * resistance_per_mmHg_s_per_mL},
               {0.005 * resistance_per_mmHg_s_per_mL},
               {0.01 * resistance_per_mmHg_s_per_mL, 0.06 * resistance_per_mmHg_s_per_mL,
                5 * compliance_per_mL_per_mmHg, 0},
               12 * compliance_per_mL_per_mmHg};
  return out;
}

/// Left and right cavity pressure, mmHg: both filling, both ejecting, the left closed while the right ejects.
const std::vector<std::array<double, 2>> kPressures{{9, 4}, {100, 25}, {60, 20}};

Vector states() {
  Vector z(6);
  z << 120e3, 130e3, 80 * kPa_per_mmHg, 14 * kPa_per_mmHg, 10 * kPa_per_mmHg, 5 * kPa_per_mmHg;
  return z;
}

Vector pressures(const std::array<double, 2>& mmHg) {
  return kPa_per_mmHg * Eigen::Vector2d(mmHg[0], mmHg[1]);
}

TEST(TwoSidedLoop, KeepsItsBlood) {
  const TwoSidedCirculation circulation(loop());
  const double before = circulation.blood_volume(states());
  for (const auto& p : kPressures) {
    const Vector rates = circulation.rates(0, states(), pressures(p)).values;
    EXPECT_GT(rates.head<2>().norm(), 1) << "blood moves";
    // blood_volume is linear: its change in a ms, against the 50 mm³ and more that the valves let through
    EXPECT_NEAR(circulation.blood_volume(states() + rates) - before, 0, 1e-6);
  }
}

TEST(TwoSidedLoop, FlowsAreThoseOfTheOpenValves) {
  const TwoSidedCirculation circulation(loop());
  const auto filling = circulation.rates(0, states(), pressures(kPressures[0])).values;
  // 1 mmHg over 0.01 and 0.02 mmHg·s/mL; the rounding of the valves at .05 mmHg adds some per mil
  EXPECT_NEAR(filling[left_volume] / flow_per_mL_per_s, 100, 0.5);
  EXPECT_NEAR(filling[right_volume] / flow_per_mL_per_s, 50, 0.5);
  const auto ejection = circulation.rates(0, states(), pressures(kPressures[1])).values;
  EXPECT_NEAR(ejection[left_volume] / flow_per_mL_per_s, -20 / 0.047, 0.5);
  EXPECT_NEAR(ejection[right_volume] / flow_per_mL_per_s, -11 / 0.015, 0.5);
  // What leaves the systemic compliance through 1 mmHg·s/mL arrives before the right ventricle.
  const auto closed = circulation.rates(0, states(), pressures({60, 10})).values;
  EXPECT_NEAR(closed[systemic_arterial_pressure] / kPa_per_mmHg * 1000, -75 / 1.3, 0.2);
  EXPECT_NEAR(closed[systemic_venous_pressure] / kPa_per_mmHg * 1000, 75 / 12.0, 0.1);
}

TEST(TwoSidedLoop, ALeakLetsBloodBackThroughTheProximalResistanceToo) {
  TwoSidedLoop leaking = loop();
  leaking.left.outlet.leak_kPa_ms_per_mm3 = 0.36 * resistance_per_mmHg_s_per_mL;
  // 60 mmHg in the cavity, 80 behind the valve: 20 over 0.36 + 0.04 mmHg·s/mL flow back.
  const auto rates = TwoSidedCirculation(leaking).rates(0, states(), pressures(kPressures[2])).values;
  EXPECT_NEAR(rates[left_volume] / flow_per_mL_per_s, 20 / 0.4, 0.1);
}

TEST(TwoSidedLoop, DerivativesAreThoseOfTheRates) {
  const TwoSidedCirculation circulation(loop());
  for (const auto& mmHg : kPressures) {
    const Vector p = pressures(mmHg);
    const auto at = circulation.rates(0, states(), p);
    ASSERT_GT(at.by_states.norm(), 0);
    const auto difference = [&](int k, bool of_pressure) {
      const double h = of_pressure || k > 1 ? 1e-6 : 1;
      Vector z_up = states(), z_down = z_up, p_up = p, p_down = p;
      (of_pressure ? p_up : z_up)[k] += h;
      (of_pressure ? p_down : z_down)[k] -= h;
      return Vector((circulation.rates(0, z_up, p_up).values - circulation.rates(0, z_down, p_down).values) /
                    (2 * h));
    };
    for (int k = 0; k < 6; ++k)
      EXPECT_LT((difference(k, false) - at.by_states.col(k)).norm(), 1e-5 * at.by_states.norm()) << k;
    for (int k = 0; k < 2; ++k)
      EXPECT_LT((difference(k, true) - at.by_pressures.col(k)).norm(), 1e-5 * at.by_pressures.norm()) << k;
  }
}

}  // namespace
}  // namespace cardiac
