#include "cardiac/circulation/valve.hpp"

#include <algorithm>
#include <cmath>

namespace cardiac {

ValveFlow valve_flow(const Valve& valve, double pressure_drop_kPa) {
  const double eps = valve.smoothing_kPa;
  const auto opening = [&](double drop) {
    const double tail = std::exp(-std::abs(drop) / eps);
    return ValveFlow{std::max(drop, 0.0) + eps * std::log1p(tail), (drop > 0 ? 1 : tail) / (1 + tail)};
  };
  const ValveFlow forward = opening(pressure_drop_kPa), backward = opening(-pressure_drop_kPa);
  const double r = valve.resistance_kPa_ms_per_mm3, leak = valve.leak_kPa_ms_per_mm3;
  return {forward.flow_mm3_per_ms / r - backward.flow_mm3_per_ms / leak,
          forward.slope / r + backward.slope / leak};
}

bool is_open(const Valve& valve, double pressure_drop_kPa) {
  return pressure_drop_kPa > -10 * valve.smoothing_kPa;
}

}  // namespace cardiac
