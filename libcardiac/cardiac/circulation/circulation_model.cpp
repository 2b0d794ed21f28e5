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

}  // namespace cardiac
