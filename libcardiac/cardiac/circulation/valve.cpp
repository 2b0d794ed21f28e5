#include "cardiac/circulation/valve.hpp"

#include <algorithm>
#include <cmath>

namespace cardiac {
namespace {
constexpr double kOrdinaryResistance = 0.01 * resistance_per_mmHg_s_per_mL;  // R₀
}  // namespace

ValveFlow valve_flow(const Valve& valve, double pressure_drop_kPa) {
  const double eps =
      valve.smoothing_kPa * std::sqrt(std::min(valve.resistance_kPa_ms_per_mm3 / kOrdinaryResistance, 1.0));
  const double root = std::hypot(pressure_drop_kPa, eps);
  const auto opening = [&](double drop) { return drop > 0 ? root + drop : eps * eps / (root - drop); };
  const double forward = opening(pressure_drop_kPa) / (2 * valve.resistance_kPa_ms_per_mm3);
  const double backward = opening(-pressure_drop_kPa) / (2 * valve.leak_kPa_ms_per_mm3);
  return {forward - backward, (forward + backward) / root};
}

bool is_open(const Valve& valve, double pressure_drop_kPa) {
  return pressure_drop_kPa > -10 * valve.smoothing_kPa;
}

}  // namespace cardiac
