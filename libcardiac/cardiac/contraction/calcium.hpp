#pragma once

#include <memory>

#include <cardiac/core/given_curve.hpp>

namespace cardiac {

/// Calcium in the cytosol since excitation, repeated with the period:
///   Ca(t) = Ca₀ + (Ca_max − Ca₀)/β (e^(−t/τ₁) − e^(−t/τ₂)),  τ₁ > τ₂,
/// β such that Ca_max is the peak. What is left of a beat goes on in the next (all earlier beats are summed),
/// so that a fast rate raises the diastolic value. Source of form and values: Rice et al. 2008; Regazzoni,
/// Dedè, Quarteroni 2020 (human).
struct CalciumTransient {
  double diastolic_uM = 0.1;
  double peak_uM = 0.9;
  double decay_ms = 50, rise_ms = 20;  ///< τ₁, τ₂
  double period_ms = 800;
  std::shared_ptr<const GivenCurve> given{};  ///< µM, instead of all that

  /// µM at a time since excitation.
  double at(double since_ms) const;
};

}  // namespace cardiac
