#include "cardiac/circulation/circulation_model.hpp"

namespace cardiac {

using polyaffine::Vector;

CirculationModel::Names CirculationModel::names(int cavity) const {
  if (cavity == 0)
    return {"pulmonary_veins", "left_ventricle", "aorta",           "systemic_arteries",
            "mitral_valve",    "aortic_valve",   "systemic_vessels"};
  return {"systemic_veins",  "right_ventricle", "pulmonary_artery", "pulmonary_arteries",
          "tricuspid_valve", "pulmonary_valve", "pulmonary_vessels"};
}

std::vector<CirculationModel::Reading> CirculationModel::readings(double time_ms, const Vector& states,
                                                                  const Vector& pressures_kPa) const {
  std::vector<Reading> out;
  for (int k = 0; k < num_cavities(); ++k) {
    const Names told = names(k);
    const Side at = side(k, time_ms, states, pressures_kPa);
    out.push_back({told.before, Quantity::pressure, at.before_kPa});
    out.push_back({told.ventricle, Quantity::pressure, pressures_kPa[k]});
    out.push_back({told.artery, Quantity::pressure, at.artery_kPa});
    out.push_back({told.arteries, Quantity::pressure, at.capacitor_kPa});
    if (!is_closed()) out.push_back({names(1 - k).before, Quantity::pressure, at.behind_kPa});
    out.push_back({told.inlet, Quantity::flow, at.inflow_mm3_per_ms});
    out.push_back({told.outlet, Quantity::flow, at.outflow_mm3_per_ms});
    out.push_back({told.vessels, Quantity::flow, at.run_off_mm3_per_ms});
    out.push_back({told.ventricle, Quantity::volume, states[k]});
  }
  return out;
}

std::vector<CirculationModel::Balance> CirculationModel::balances(double time_ms, const Vector& states,
                                                                  const Vector& pressures_kPa) const {
  std::vector<Balance> out;
  for (int k = 0; k < num_cavities(); ++k) {
    const Side at = side(k, time_ms, states, pressures_kPa);
    out.push_back({names(k).arteries, at.outflow_mm3_per_ms, at.run_off_mm3_per_ms});
  }
  return out;
}

CirculationModel::Rates LeftHeartCirculation::rates(double, const Vector& states,
                                                    const Vector& pressures_kPa) const {
  const LoopResidual at_rest = loop_residual(loop_, 0, pressures_kPa[0], states[1], 0);
  const double C = at_rest.capacitor_by_capacitor_rate;
  Rates out{Vector(2), polyaffine::Matrix::Zero(2, 2), polyaffine::Matrix(2, 1)};
  out.values << -at_rest.volume, -at_rest.capacitor / C;
  out.by_states(0, 1) = -at_rest.volume_by_capacitor_pressure;
  out.by_states(1, 1) = -at_rest.capacitor_by_capacitor_pressure / C;
  out.by_pressures << -at_rest.volume_by_pressure, -at_rest.capacitor_by_pressure / C;
  return out;
}

CirculationModel::Side LeftHeartCirculation::side(int, double, const Vector& states,
                                                  const Vector& pressures_kPa) const {
  const double capacitor = states[1], behind = loop_.arteries.reference_pressure_kPa;
  const LoopFlows flows = loop_flows(loop_, pressures_kPa[0], capacitor);
  return {.before_kPa = loop_.filling_pressure_kPa,
          .capacitor_kPa = capacitor,
          .artery_kPa = flows.aortic_pressure_kPa,
          .behind_kPa = behind,
          .inflow_mm3_per_ms = flows.mitral_mm3_per_ms,
          .outflow_mm3_per_ms = flows.aortic_mm3_per_ms,
          .run_off_mm3_per_ms = (capacitor - behind) / loop_.arteries.peripheral_resistance_kPa_ms_per_mm3,
          .inlet_mm3_per_ms = flows.mitral_mm3_per_ms,
          .outlet_mm3_per_ms = flows.aortic_mm3_per_ms};
}

Vector LeftHeartCirculation::compliances() const {
  return (Vector(2) << 0, loop_.arteries.compliance_mm3_per_kPa).finished();
}

double LeftHeartCirculation::slowest_ms() const {
  return loop_.arteries.peripheral_resistance_kPa_ms_per_mm3 * loop_.arteries.compliance_mm3_per_kPa;
}

}  // namespace cardiac
