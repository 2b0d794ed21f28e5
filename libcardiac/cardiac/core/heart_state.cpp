#include "cardiac/core/heart_state.hpp"

namespace cardiac {

using polyaffine::Vector;

Vector circulation_states(const HeartState& s) {
  if (s.loop.size() == 0) return Vector{{s.volume_mm3, s.capacitor_pressure_kPa}};
  Vector out(3 + s.loop.size());
  out << s.volume_mm3, s.right_volume_mm3, s.capacitor_pressure_kPa, s.loop;
  return out;
}

Vector cavity_pressures(const HeartState& s) {
  if (s.loop.size() == 0) return Vector{{s.pressure_kPa}};
  return Vector{{s.pressure_kPa, s.right_pressure_kPa}};
}

}  // namespace cardiac
