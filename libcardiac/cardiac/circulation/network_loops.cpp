#include <utility>

#include "cardiac/circulation/network.hpp"

// The loops of this folder as networks.
namespace cardiac {
namespace {

Element joined(std::string name, std::string from, std::string to, ElementType type, Valve valve) {
  Element out;
  out.name = std::move(name);
  out.from = std::move(from);
  out.to = std::move(to);
  out.type = type;
  out.valve = valve;
  return out;
}

Element small_vessels(std::string name, std::string from, std::string to, double resistance) {
  return joined(std::move(name), std::move(from), std::move(to), ElementType::resistance,
                {.resistance_kPa_ms_per_mm3 = resistance});
}

Compartment ventricle(std::string name, CavityName cavity, double filling_kPa) {
  Compartment out;
  out.name = std::move(name);
  out.type = CompartmentType::ventricle;
  out.cavity = cavity;
  out.pressure_kPa = filling_kPa;
  return out;
}

Compartment vessel(std::string name, double compliance, double pressure_kPa) {
  Compartment out;
  out.name = std::move(name);
  out.compliance_mm3_per_kPa = compliance;
  out.pressure_kPa = pressure_kPa;
  return out;
}

Compartment given(std::string name, double pressure_kPa) {
  Compartment out;
  out.name = std::move(name);
  out.type = CompartmentType::pressure;
  out.pressure_kPa = pressure_kPa;
  return out;
}

Element outlet_of(std::string name, std::string from, std::string to, const Valve& valve,
                  const Windkessel& arteries, std::string between) {
  Element out = joined(std::move(name), std::move(from), std::move(to), ElementType::valve, valve);
  out.series_kPa_ms_per_mm3 = arteries.proximal_resistance_kPa_ms_per_mm3;
  out.between = std::move(between);
  return out;
}

}  // namespace

CirculationNetwork network_of(const LeftHeartLoop& loop, double capacitor_kPa) {
  const Windkessel& w = loop.arteries;
  return {.compartments = {given("pulmonary_veins", loop.filling_pressure_kPa),
                           ventricle("left_ventricle", CavityName::lv, loop.filling_pressure_kPa),
                           vessel("systemic_arteries", w.compliance_mm3_per_kPa, capacitor_kPa),
                           given("systemic_veins", w.reference_pressure_kPa)},
          .elements = {
              joined("mitral_valve", "pulmonary_veins", "left_ventricle", ElementType::valve, loop.mitral),
              outlet_of("aortic_valve", "left_ventricle", "systemic_arteries", loop.aortic, w, "aorta"),
              small_vessels("systemic_vessels", "systemic_arteries", "systemic_veins",
                            w.peripheral_resistance_kPa_ms_per_mm3)}};
}

CirculationNetwork network_of(const TwoSidedLoop& loop, const polyaffine::Vector& vessels_kPa,
                              const polyaffine::Vector& filling_kPa) {
  const TwoSidedLoop::Side &left = loop.left, &right = loop.right;
  const auto p = [&](int index) { return vessels_kPa[index - 2]; };  // behind the volumes
  return {
      .compartments =
          {ventricle("left_ventricle", CavityName::lv, filling_kPa[0]),
           ventricle("right_ventricle", CavityName::rv, filling_kPa[1]),
           vessel("systemic_arteries", left.arteries.compliance_mm3_per_kPa, p(systemic_arterial_pressure)),
           vessel("pulmonary_arteries", right.arteries.compliance_mm3_per_kPa,
                  p(pulmonary_arterial_pressure)),
           vessel("pulmonary_veins", left.venous_compliance_mm3_per_kPa, p(pulmonary_venous_pressure)),
           vessel("systemic_veins", right.venous_compliance_mm3_per_kPa, p(systemic_venous_pressure))},
      .elements = {
          joined("mitral_valve", "pulmonary_veins", "left_ventricle", ElementType::valve, left.inlet),
          outlet_of("aortic_valve", "left_ventricle", "systemic_arteries", left.outlet, left.arteries,
                    "aorta"),
          small_vessels("systemic_vessels", "systemic_arteries", "systemic_veins",
                        left.arteries.peripheral_resistance_kPa_ms_per_mm3),
          joined("tricuspid_valve", "systemic_veins", "right_ventricle", ElementType::valve, right.inlet),
          outlet_of("pulmonary_valve", "right_ventricle", "pulmonary_arteries", right.outlet, right.arteries,
                    "pulmonary_artery"),
          small_vessels("pulmonary_vessels", "pulmonary_arteries", "pulmonary_veins",
                        right.arteries.peripheral_resistance_kPa_ms_per_mm3)}};
}

CirculationNetwork network_of(const ClosedLoop& loop, const ClosedLoopState& start, bool lv_is_cavity,
                              bool rv_is_cavity) {
  CirculationNetwork out;
  out.period_ms = loop.period_ms;
  const auto chamber = [&](const char* name, const Elastance& e, int state) {
    Compartment c;
    c.name = name;
    c.type = CompartmentType::chamber;
    c.chamber.elastance = e;
    c.initial_volume_mm3 = start[state];
    out.compartments.push_back(std::move(c));
  };
  const auto filling = [&](const Elastance& e, int state) {
    return chamber_pressure(loop, e, 0, start[state]);
  };
  chamber("left_atrium", loop.la, volume_la);
  if (lv_is_cavity)
    out.compartments.push_back(ventricle("left_ventricle", CavityName::lv, filling(loop.la, volume_la)));
  else
    chamber("left_ventricle", loop.lv, volume_lv);
  chamber("right_atrium", loop.ra, volume_ra);
  if (rv_is_cavity)
    out.compartments.push_back(ventricle("right_ventricle", CavityName::rv, filling(loop.ra, volume_ra)));
  else
    chamber("right_ventricle", loop.rv, volume_rv);

  const Valve valve{.resistance_kPa_ms_per_mm3 = loop.open_valve_kPa_ms_per_mm3,
                    .leak_kPa_ms_per_mm3 = loop.closed_valve_kPa_ms_per_mm3,
                    .law = ValveLaw::arctan,
                    .sharpness_per_kPa = loop.valve_sharpness_per_kPa};
  const auto add_valve = [&](const char* name, const char* from, const char* to) {
    out.elements.push_back(joined(name, from, to, ElementType::valve, valve));
  };
  const auto add_vessel = [&](const char* name, const char* flow, const char* to, const Vessel& v,
                              int pressure, int rate) {
    out.compartments.push_back(vessel(name, v.compliance_mm3_per_kPa, start[pressure]));
    Element e = small_vessels(flow, name, to, v.resistance_kPa_ms_per_mm3);
    e.inertance_kPa_ms2_per_mm3 = v.inertance_kPa_ms2_per_mm3;
    e.initial_flow_mm3_per_ms = start[rate];
    out.elements.push_back(std::move(e));
  };
  add_valve("mitral_valve", "left_atrium", "left_ventricle");
  add_valve("aortic_valve", "left_ventricle", "systemic_arteries");
  add_valve("tricuspid_valve", "right_atrium", "right_ventricle");
  add_valve("pulmonary_valve", "right_ventricle", "pulmonary_arteries");
  add_vessel("systemic_arteries", "systemic_vessels", "systemic_veins", loop.systemic_arteries,
             pressure_systemic_arteries, flow_systemic_arteries);
  add_vessel("systemic_veins", "venous_return", "right_atrium", loop.systemic_veins, pressure_systemic_veins,
             flow_systemic_veins);
  add_vessel("pulmonary_arteries", "pulmonary_vessels", "pulmonary_veins", loop.pulmonary_arteries,
             pressure_pulmonary_arteries, flow_pulmonary_arteries);
  add_vessel("pulmonary_veins", "pulmonary_return", "left_atrium", loop.pulmonary_veins,
             pressure_pulmonary_veins, flow_pulmonary_veins);
  return out;
}

}  // namespace cardiac
