#include "cardiac/scene/loops.hpp"

namespace cardiac {

LeftHeartLoop left_heart_loop(const scene::Circulation& c) {
  LeftHeartLoop loop;
  loop.filling_pressure_kPa = c.filling_pressure_kPa;
  loop.mitral.resistance_kPa_ms_per_mm3 = c.mitral_resistance_kPa_ms_per_mm3;
  loop.aortic.resistance_kPa_ms_per_mm3 = c.aortic_valve_resistance_kPa_ms_per_mm3;
  if (c.aortic_leak_resistance_kPa_ms_per_mm3)
    loop.aortic.leak_kPa_ms_per_mm3 = *c.aortic_leak_resistance_kPa_ms_per_mm3;
  loop.arteries = {c.characteristic_resistance_kPa_ms_per_mm3, c.peripheral_resistance_kPa_ms_per_mm3,
                   c.compliance_mm3_per_kPa, c.venous_pressure_kPa};
  return loop;
}

TwoSidedLoop two_sided_loop(const scene::Circulation& c) {
  const LeftHeartLoop left = left_heart_loop(c);
  TwoSidedLoop loop;
  loop.left.inlet = left.mitral;
  loop.left.outlet = left.aortic;
  loop.left.arteries = left.arteries;
  loop.left.venous_compliance_mm3_per_kPa = c.pulmonary_venous_compliance_mm3_per_kPa;
  loop.right.inlet.resistance_kPa_ms_per_mm3 = c.tricuspid_resistance_kPa_ms_per_mm3;
  loop.right.outlet.resistance_kPa_ms_per_mm3 = c.pulmonary_valve_resistance_kPa_ms_per_mm3;
  loop.right.arteries = {c.pulmonary_characteristic_resistance_kPa_ms_per_mm3,
                         c.pulmonary_peripheral_resistance_kPa_ms_per_mm3, c.pulmonary_compliance_mm3_per_kPa,
                         0};
  loop.right.venous_compliance_mm3_per_kPa = c.systemic_venous_compliance_mm3_per_kPa;
  return loop;
}

std::shared_ptr<const CirculationModel> circulation_model(bool two_ventricles, const scene::Circulation& c) {
  if (two_ventricles) return std::make_shared<TwoSidedCirculation>(two_sided_loop(c));
  return std::make_shared<LeftHeartCirculation>(left_heart_loop(c));
}

}  // namespace cardiac
