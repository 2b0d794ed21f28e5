#pragma once

namespace cardiac {

/// A chamber as a time-varying elastance, p = E(t) (V − V₀); kPa, mm³, ms. E rises from the passive by the
/// active elastance and falls back, both in half a cosine, in every heart period.
struct Elastance {
  double active_kPa_per_mm3 = 0;   ///< E_A
  double passive_kPa_per_mm3 = 0;  ///< E_B
  double onset_ms = 0;             ///< t_C, begin of contraction within the period
  double contraction_ms = 0;       ///< T_C, duration
  double relaxation_ms = 0;        ///< T_R, duration
  double unstressed_volume_mm3 = 0;
};

/// E(t) in kPa/mm³, periodic: E_B + E_A ½(1 − cos(π s/T_C)) for 0 ≤ s = t − t_C < T_C, then
/// E_B + E_A ½(1 + cos(π (s − T_C)/T_R)) until T_C + T_R, then E_B. Source: Regazzoni et al. 2022.
double elastance_at(const Elastance& chamber, double period_ms, double time_ms);

}  // namespace cardiac
