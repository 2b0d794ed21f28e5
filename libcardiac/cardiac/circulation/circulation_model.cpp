#include "cardiac/circulation/circulation_model.hpp"

namespace cardiac {

using polyaffine::Vector;

CirculationModel::Rates LeftHeartCirculation::rates(const Vector& states, const Vector& pressures_kPa) const {
  const LoopResidual at_rest = loop_residual(loop_, 0, pressures_kPa[0], states[1], 0);
  const double C = at_rest.capacitor_by_capacitor_rate;
  Rates out{Vector(2), polyaffine::Matrix::Zero(2, 2), polyaffine::Matrix(2, 1)};
  out.values << -at_rest.volume, -at_rest.capacitor / C;
  out.by_states(0, 1) = -at_rest.volume_by_capacitor_pressure;
  out.by_states(1, 1) = -at_rest.capacitor_by_capacitor_pressure / C;
  out.by_pressures << -at_rest.volume_by_pressure, -at_rest.capacitor_by_pressure / C;
  return out;
}

CirculationModel::Side LeftHeartCirculation::side(int, const Vector& states,
                                                  const Vector& pressures_kPa) const {
  const double capacitor = states[1], behind = loop_.arteries.reference_pressure_kPa;
  const LoopFlows flows = loop_flows(loop_, pressures_kPa[0], capacitor);
  return {.before_kPa = loop_.filling_pressure_kPa,
          .capacitor_kPa = capacitor,
          .artery_kPa = flows.aortic_pressure_kPa,
          .behind_kPa = behind,
          .inflow_mm3_per_ms = flows.mitral_mm3_per_ms,
          .outflow_mm3_per_ms = flows.aortic_mm3_per_ms,
          .run_off_mm3_per_ms = (capacitor - behind) / loop_.arteries.peripheral_resistance_kPa_ms_per_mm3};
}

Vector LeftHeartCirculation::compliances() const {
  return (Vector(2) << 0, loop_.arteries.compliance_mm3_per_kPa).finished();
}

}  // namespace cardiac
