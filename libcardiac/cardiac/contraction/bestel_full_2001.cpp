#include "cardiac/contraction/bestel_full_2001.hpp"

#include <algorithm>
#include <cmath>

#include <polyaffine/material/parameters.hpp>

namespace cardiac {
namespace {

enum State { force, stress, stiffness };  // x, τ_c/σ₀, k_c/k₀

}  // namespace

BestelFull2001::BestelFull2001(const BestelParameters& contraction, const BridgeParameters& bridges,
                               double period_ms)
    : p_(contraction), b_(bridges), period_ms_(period_ms) {
  check_contraction(contraction, period_ms);
  polyaffine::require_positive("contraction: contractility", p_.contractility_kPa, "kPa");
  polyaffine::require_positive("contraction: viscosity of the bridges", b_.viscosity_kPa_ms, "kPa ms");
  polyaffine::require_positive("contraction: series stiffness", b_.series_stiffness_kPa, "kPa");
}

double BestelFull2001::drive(double since_ms) const {
  return activation_rate(p_, period_ms_, since_ms);
}

void BestelFull2001::respond(const FibreMotion& at, const States& z, bool derivatives,
                             SarcomereResponse& r) const {
  const double sigma = p_.contractility_kPa, k_s = b_.series_stiffness_kPa, mu = b_.viscosity_kPa_ms;
  const double up = std::max(at.drive, 0.0);
  const double speed = sigma * (z[force] - z[stress]) / mu;  // ė_c
  const double decay = std::abs(at.drive) + b_.rate_destruction * std::abs(speed);
  const double ratio = b_.bridge_stiffness_kPa / sigma;
  const Overlap overlap = filament_overlap(at.stretch - z[force] * sigma / k_s, b_.overlap_slope);
  r.tension_kPa = sigma * z[force];
  r.rates[force] = k_s / sigma * (at.rate_per_ms - speed);
  r.rates[stress] = -decay * z[stress] + ratio * z[stiffness] * speed + overlap.value * up;
  r.rates[stiffness] = -decay * z[stiffness] + overlap.value * up;
  if (!derivatives) return;
  r.by_stretch = 0;
  r.by_state = {sigma, 0, 0};
  r.rates_by_stretch = {0, overlap.slope * up, overlap.slope * up};
  r.rates_by_rate = {k_s / sigma, 0, 0};
  // ė_c rises with x as it falls with τ_c.
  const double by_force = sigma / mu, sign = speed > 0 ? 1 : speed < 0 ? -1 : 0;
  const double decay_by = b_.rate_destruction * sign * by_force;
  const double overlap_by = -overlap.slope * sigma / k_s * up;
  const double pull = -decay_by * z[stress] + ratio * z[stiffness] * by_force;
  auto& J = r.rates_by_state;
  J[force] = {-k_s / sigma * by_force, k_s / sigma * by_force, 0};
  J[stress] = {pull + overlap_by, -pull - decay, ratio * speed};
  J[stiffness] = {-decay_by * z[stiffness] + overlap_by, decay_by * z[stiffness], -decay};
}

// Bridges that are held: τ_c/σ₀ = k_c/k₀ = n₀ where the muscle is active, none where it is not. The series
// spring stretches by so little that n₀ is found in a few rounds.
SarcomereModel::States BestelFull2001::at_rest(double drive, double stretch) const {
  if (drive <= 0) return {};
  constexpr int kRounds = 20;
  double x = 0;
  for (int i = 0; i < kRounds; ++i)
    x = filament_overlap(stretch - x * p_.contractility_kPa / b_.series_stiffness_kPa, b_.overlap_slope)
            .value;
  return {x, x, x};
}

}  // namespace cardiac
