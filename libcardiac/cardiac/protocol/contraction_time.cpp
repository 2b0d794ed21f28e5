#include <cardiac/protocol/contraction_time.hpp>

#include <cmath>

namespace cardiac {
namespace {

constexpr double kDuration_ms = 324;  // Aróstica et al. 2025
constexpr double kAtBeat_ms = 800;    // 75 beats a minute

}  // namespace

double beat_ms(const protocol::Time& time) {
  return 60000 / time.heart_rate_bpm;
}

double activation_duration_ms(const protocol::Contraction& contraction, const protocol::Time& time) {
  return contraction.activation_duration_ms.value_or(kDuration_ms * std::sqrt(beat_ms(time) / kAtBeat_ms));
}

BestelParameters bestel_parameters(const protocol::Contraction& c, const protocol::Time& time) {
  return {c.activation_rate_per_s / 1000,
          c.relaxation_rate_per_s / 1000,
          c.contractility_kPa,
          0,
          activation_duration_ms(c, time),
          c.switch_width_ms};
}

}  // namespace cardiac
