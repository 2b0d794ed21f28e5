#include "cardiac/scene/loops.hpp"

#include <algorithm>

#include <cardiac/circulation/network_circulation.hpp>
#include <polyaffine/core/error.hpp>

namespace cardiac {

using polyaffine::Vector;

namespace {

// The healthy closed loop with its times, published at 75 beats a minute, stretched to a beat.
ClosedLoop closed_loop_of(double beat_ms) {
  ClosedLoop loop = healthy_closed_loop();
  const double factor = beat_ms / loop.period_ms;
  loop.period_ms = beat_ms;
  for (Elastance* chamber : {&loop.la, &loop.lv, &loop.ra, &loop.rv})
    for (double* time : {&chamber->onset_ms, &chamber->contraction_ms, &chamber->relaxation_ms})
      *time *= factor;
  return loop;
}

void check_cavities(const CirculationNetwork& network, bool two_ventricles) {
  const auto has = [&](CavityName cavity) {
    return std::ranges::any_of(network.compartments, [&](const Compartment& c) {
      return c.type == CompartmentType::ventricle && c.cavity == cavity;
    });
  };
  if (!has(CavityName::lv))
    throw polyaffine::InputError(
        "circulation: found no compartment that is the left ventricle of the mesh, expected one of the type "
        "ventricle with cavity = \"lv\"");
  if (has(CavityName::rv) == two_ventricles) return;
  throw polyaffine::InputError(
      two_ventricles
          ? "circulation: found no compartment that is the right ventricle of the mesh, expected one "
            "of the type ventricle with cavity = \"rv\""
          : "circulation: found a compartment with cavity = \"rv\", expected none: the mesh has no "
            "right ventricle");
}

}  // namespace

LeftHeartLoop left_heart_loop(const scene::Circulation& c) {
  LeftHeartLoop loop;
  loop.filling_pressure_kPa = c.filling_pressure_kPa;
  loop.mitral.resistance_kPa_ms_per_mm3 = c.mitral_resistance_kPa_ms_per_mm3;
  loop.aortic.resistance_kPa_ms_per_mm3 = c.aortic_valve_resistance_kPa_ms_per_mm3;
  if (c.aortic_leak_resistance_kPa_ms_per_mm3)
    loop.aortic.leak_kPa_ms_per_mm3 = *c.aortic_leak_resistance_kPa_ms_per_mm3;
  if (c.mitral_leak_resistance_kPa_ms_per_mm3)
    loop.mitral.leak_kPa_ms_per_mm3 = *c.mitral_leak_resistance_kPa_ms_per_mm3;
  loop.mitral.stenosis_kPa_ms2_per_mm6 = c.mitral_stenosis_kPa_ms2_per_mm6;
  loop.aortic.stenosis_kPa_ms2_per_mm6 = c.aortic_stenosis_kPa_ms2_per_mm6;
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
  if (c.tricuspid_leak_resistance_kPa_ms_per_mm3)
    loop.right.inlet.leak_kPa_ms_per_mm3 = *c.tricuspid_leak_resistance_kPa_ms_per_mm3;
  if (c.pulmonary_leak_resistance_kPa_ms_per_mm3)
    loop.right.outlet.leak_kPa_ms_per_mm3 = *c.pulmonary_leak_resistance_kPa_ms_per_mm3;
  loop.right.inlet.stenosis_kPa_ms2_per_mm6 = c.tricuspid_stenosis_kPa_ms2_per_mm6;
  loop.right.outlet.stenosis_kPa_ms2_per_mm6 = c.pulmonary_stenosis_kPa_ms2_per_mm6;
  loop.right.arteries = {c.pulmonary_characteristic_resistance_kPa_ms_per_mm3,
                         c.pulmonary_peripheral_resistance_kPa_ms_per_mm3, c.pulmonary_compliance_mm3_per_kPa,
                         0};
  loop.right.venous_compliance_mm3_per_kPa = c.systemic_venous_compliance_mm3_per_kPa;
  return loop;
}

std::shared_ptr<const CirculationNetwork> network_of(bool two_ventricles, const Scene& scene) {
  const scene::Circulation& c = *scene.circulation;
  if (c.network) return c.network;
  if (c.loop != scene::Loop::closed_2022) return nullptr;
  return std::make_shared<CirculationNetwork>(
      network_of(closed_loop_of(scene.time.beat_ms), healthy_closed_loop_state(), true, two_ventricles));
}

std::shared_ptr<const CirculationModel> circulation_model(bool two_ventricles, const Scene& scene) {
  const scene::Circulation& c = *scene.circulation;
  if (const auto network = network_of(two_ventricles, scene)) {
    check_cavities(*network, two_ventricles);
    return std::make_shared<NetworkCirculation>(*network, scene.time.beat_ms);
  }
  if (two_ventricles) return std::make_shared<TwoSidedCirculation>(two_sided_loop(c));
  return std::make_shared<LeftHeartCirculation>(left_heart_loop(c));
}

CirculationStart circulation_start(bool two_ventricles, const Scene& scene) {
  const scene::Circulation& c = *scene.circulation;
  if (const auto network = network_of(two_ventricles, scene)) {
    const NetworkCirculation circulation(*network, scene.time.beat_ms);
    return {circulation.filling_pressures(), circulation.initial_states()};
  }
  if (two_ventricles)
    return {Vector{{c.filling_pressure_kPa, c.right_filling_pressure_kPa}},
            Vector{{c.initial_aortic_pressure_kPa, c.initial_pulmonary_pressure_kPa, c.filling_pressure_kPa,
                    c.right_filling_pressure_kPa}}};
  return {Vector{{c.filling_pressure_kPa}}, Vector{{c.initial_aortic_pressure_kPa}}};
}

}  // namespace cardiac
