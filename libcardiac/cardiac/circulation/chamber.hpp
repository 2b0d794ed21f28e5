#pragma once

#include <cardiac/circulation/elastance.hpp>

namespace cardiac {

/// How a chamber's activity A(t) runs over a heart period.
enum class Activity {
  cosine,    ///< up and down in half a cosine each (elastance_at)
  two_hill,  ///< a product of two Hill functions, its largest value one (Brown et al. 2023)
  fourier    ///< a series of 25 terms of a measured elastance (Menon et al. 2023)
};

/// A chamber that nobody computes the wall of; kPa, mm³, ms. With s = A(t) and V₀ = V_d − s (V_d − V_s),
///   p = (E_B + s E_A) (V − V₀),
/// or where the passive chamber stiffens,
///   p = s E_A (V − V₀) + (1 − s) K (exp(k (V − V₀)) − 1).
struct Chamber {
  Elastance elastance;  ///< E_A, E_B, times, V_d
  Activity activity = Activity::cosine;
  double systolic_volume_change_mm3 = 0;        ///< V_s − V_d
  double passive_kPa = 0, passive_per_mm3 = 0;  ///< K and k; K = 0: the linear chamber
  /// Of two_hill, counted from the elastance's onset: ms and exponents.
  double rise_ms = 0, fall_ms = 0, rise_exponent = 0, fall_exponent = 0;
  double hill_scale = 1;  ///< one over the largest product (scale_of_hills)
};

struct ChamberPressure {
  double pressure_kPa, stiffness;  ///< stiffness ∂p/∂V in kPa/mm³
};
ChamberPressure pressure_in(const Chamber& chamber, double period_ms, double time_ms, double volume_mm3);

/// A(t), periodic.
double activity_at(const Chamber& chamber, double period_ms, double time_ms);

/// The hill_scale with which the activity's largest value in a period is one.
double scale_of_hills(const Chamber& chamber, double period_ms);

}  // namespace cardiac
