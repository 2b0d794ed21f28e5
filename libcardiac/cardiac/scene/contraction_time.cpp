#include <cardiac/scene/contraction_time.hpp>

#include <cmath>

namespace cardiac {
namespace {

constexpr double kDuration_ms = 324;  // Aróstica et al. 2025
constexpr double kAtBeat_ms = 800;    // 75 beats a minute

}  // namespace

double activation_duration_ms(const scene::Contraction& contraction, const scene::Time& time) {
  return contraction.activation_duration_ms.value_or(kDuration_ms * std::sqrt(time.beat_ms / kAtBeat_ms));
}

BestelParameters bestel_parameters(const scene::Contraction& c, const scene::Time& time) {
  return {c.activation_rate_per_ms,        c.relaxation_rate_per_ms, c.contractility_kPa, 0,
          activation_duration_ms(c, time), c.switch_width_ms};
}

}  // namespace cardiac
