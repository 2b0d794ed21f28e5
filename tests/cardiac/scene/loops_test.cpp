#include <gtest/gtest.h>

#include <cardiac/core/units.hpp>
#include <cardiac/scene/loops.hpp>

namespace cardiac {
namespace {

scene::Circulation circulation() {
  scene::Circulation out;
  out.mitral_resistance_kPa_ms_per_mm3 = 0.01 * resistance_per_mmHg_s_per_mL;
  out.aortic_valve_resistance_kPa_ms_per_mm3 = 0.02 * resistance_per_mmHg_s_per_mL;
  out.characteristic_resistance_kPa_ms_per_mm3 = 0.08 * resistance_per_mmHg_s_per_mL;
  out.aortic_leak_resistance_kPa_ms_per_mm3 = 0.32 * resistance_per_mmHg_s_per_mL;
  out.peripheral_resistance_kPa_ms_per_mm3 = 2 * resistance_per_mmHg_s_per_mL;
  out.compliance_mm3_per_kPa = 1.5 * compliance_per_mL_per_mmHg;
  out.venous_pressure_kPa = 5 * kPa_per_mmHg;
  out.filling_pressure_kPa = 12 * kPa_per_mmHg;
  return out;
}

// Every resistance once, between the pressures that the protocol means. The rounding of the valves at 0.05
// mmHg adds less than 0.1 mL/s.
TEST(LoopOfAScene, OneVentricle) {
  const LeftHeartLoop loop = left_heart_loop(circulation());
  const auto flows = [&](double cavity, double arteries) {
    const LoopFlows q = loop_flows(loop, cavity * kPa_per_mmHg, arteries * kPa_per_mmHg);
    return Eigen::Vector3d(q.mitral_mm3_per_ms / flow_per_mL_per_s, q.aortic_mm3_per_ms / flow_per_mL_per_s,
                           q.aortic_pressure_kPa / kPa_per_mmHg);
  };
  const auto filling = flows(8, 80);
  EXPECT_NEAR(filling[0], (12 - 8) / 0.01, 0.1);
  EXPECT_NEAR(filling[1], -(80 - 8) / (0.32 + 0.08), 0.1);
  const auto ejection = flows(120, 100);
  EXPECT_NEAR(ejection[1], 20 / (0.02 + 0.08), 0.1);
  EXPECT_NEAR(ejection[2], 100 + 0.08 * ejection[1], 1e-9);
  const LoopRates rates = loop_rates(loop, 8 * kPa_per_mmHg, 80 * kPa_per_mmHg);
  EXPECT_NEAR(1000 * rates.capacitor_pressure_kPa_per_ms / kPa_per_mmHg, (-(80 - 5) / 2.0 + filling[1]) / 1.5,
              1e-3);
}

TEST(LoopOfAScene, TwoVentriclesHaveTheSameLeftOutlet) {
  const LeftHeartLoop one = left_heart_loop(circulation());
  const TwoSidedLoop two = two_sided_loop(circulation());
  const Valve &a = one.aortic, &b = two.left.outlet;
  EXPECT_EQ(b.resistance_kPa_ms_per_mm3, a.resistance_kPa_ms_per_mm3);
  EXPECT_EQ(b.leak_kPa_ms_per_mm3, a.leak_kPa_ms_per_mm3);
  EXPECT_EQ(two.left.arteries.proximal_resistance_kPa_ms_per_mm3,
            one.arteries.proximal_resistance_kPa_ms_per_mm3);
  EXPECT_GT(two.right.outlet.leak_kPa_ms_per_mm3, 1e300) << "tight";
}

}  // namespace
}  // namespace cardiac
