#include "cardiac/circulation/valve.hpp"

#include <cmath>

namespace cardiac {

ValveFlow valve_flow(const Valve& valve, double pressure_drop_kPa) {
  const double eps = valve.smoothing_kPa, root = std::hypot(pressure_drop_kPa, eps);
  const double opening =
      pressure_drop_kPa > 0 ? root + pressure_drop_kPa : eps * eps / (root - pressure_drop_kPa);
  const double flow = opening / (2 * valve.resistance_kPa_ms_per_mm3);
  return {flow, flow / root};
}

bool is_open(const Valve& valve, double pressure_drop_kPa) {
  return pressure_drop_kPa > -10 * valve.smoothing_kPa;
}

}  // namespace cardiac
