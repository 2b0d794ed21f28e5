#include "cardiac/circulation/elastance.hpp"

#include <cmath>
#include <polyaffine/core/types.hpp>

namespace cardiac {

double elastance_at(const Elastance& c, double period_ms, double time_ms) {
  const double t = time_ms - c.onset_ms, s = t - period_ms * std::floor(t / period_ms);
  double activity = 0;
  if (s < c.contraction_ms) {
    activity = 0.5 * (1 - std::cos(polyaffine::kPi * s / c.contraction_ms));
  } else if (s < c.contraction_ms + c.relaxation_ms) {
    activity = 0.5 * (1 + std::cos(polyaffine::kPi * (s - c.contraction_ms) / c.relaxation_ms));
  }
  return c.passive_kPa_per_mm3 + c.active_kPa_per_mm3 * activity;
}

}  // namespace cardiac
