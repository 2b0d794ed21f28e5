#pragma once

#include <polyaffine/core/types.hpp>

namespace cardiac {

/// One state of the coupled heart; coefficients of the wall, mm³, kPa, ms from the start of the beat.
struct HeartState {
  double time_ms = 0;
  polyaffine::Vector c;
  double volume_mm3 = 0, pressure_kPa = 0, capacitor_pressure_kPa = 0;  ///< of the left ventricle
  double right_volume_mm3 = 0, right_pressure_kPa = 0;
  /// Pressures of the closed loop of two ventricles, kPa: pulmonary arteries, pulmonary veins, systemic veins
  /// (those of the systemic arteries are capacitor_pressure_kPa); empty with one ventricle.
  polyaffine::Vector loop{};
};

/// States and cavity pressures of a state as of CirculationModel.
polyaffine::Vector circulation_states(const HeartState& state);
polyaffine::Vector cavity_pressures(const HeartState& state);

}  // namespace cardiac
