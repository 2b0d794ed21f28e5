#pragma once

#include <vector>

#include <cardiac/core/given_curve.hpp>
#include <polyaffine/core/types.hpp>

namespace cardiac {

using polyaffine::Vector;

/// Parameters of the simplified Bestel–Clément–Sorine contraction; ms and kPa. The defaults are those of the
/// elastodynamics benchmark of Aróstica et al. 2025 and belong to a period of 1000 ms.
struct BestelParameters {
  double activation_rate_per_ms = 0.005;  ///< α_act, while contracting
  double relaxation_rate_per_ms = 0.030;  ///< α_rel, while relaxing
  double contractility_kPa = 150;         ///< σ₀, the tension that a lasting contraction would approach
  double systole_ms = 160;                ///< t_sys, contraction begins, counted from local activation
  double diastole_ms = 484;               ///< t_dias, relaxation begins
  double steepness_ms = 5;                ///< γ, width of both switches
};

/// Throws polyaffine::InputError when a rate, σ₀, γ or the period is not positive, relaxation does not follow
/// contraction within one period, contraction is too short to take place (f never reaches α_rel / (α_act +
/// α_rel)), or the period leaves no time to relax.
void check_contraction(const BestelParameters& parameters, double period_ms);

/// f(t) = S⁺(t − t_sys) S⁻(t − t_dias), S± = ½ (1 ± tanh(·/γ)), repeated with the heart period: between 0
/// (relaxing) and 1 (contracting). Source: Aróstica et al. 2025.
double contraction_indicator(const BestelParameters& parameters, double period_ms, double time_ms);

/// a(t) = α_act f − α_rel (1 − f) in 1/ms, and the right-hand side τ̇ = −|a| τ + σ₀ max(a, 0) in kPa/ms.
/// Source: Bestel, Clément, Sorine 2001, without its dependence on the strain rate (Aróstica et al. 2025).
double activation_rate(const BestelParameters& parameters, double period_ms, double time_ms);
double tension_rate(const BestelParameters& parameters, double period_ms, double time_ms, double tension_kPa);

/// The tension τ(t) of one heart period in the steady state of lasting periodic activation, and from it that
/// of every material point: since the simplified equation does not know the deformation, a point activated at
/// t_act and weakened or strengthened by a factor has scale · τ(t − t_act).
///
/// τ is computed once by CVODE between the zeros of a, where its second derivative jumps, and kept as cubic
/// Hermite pieces (C¹; values from the solver, slopes from the equation), accurate to about 10⁻⁶ σ₀.
class TensionCurve {
 public:
  struct Sample {
    double tension_kPa, rate_kPa_per_ms;
  };

  /// Throws as check_contraction.
  TensionCurve(const BestelParameters& parameters, double period_ms);

  /// A tension that is given, kPa from the excitation of a point on; one that does not repeat has its own
  /// length as period. Contraction begins where the tension has risen by 1 % of its range, for the last time
  /// before its largest value, and ends there. Throws polyaffine::InputError where the tension does not
  /// change.
  explicit TensionCurve(const GivenCurve& given);

  /// τ and τ̇ at any time, also negative: periodic.
  Sample at(double time_ms) const;

  /// tension[i] = scale[i] · τ(time − delay[i]) and its time derivative for all points; sizes must agree.
  void evaluate(double time_ms, const Vector& delay_ms, const Vector& scale, Eigen::Ref<Vector> tension_kPa,
                Eigen::Ref<Vector> rate_kPa_per_ms) const;

  double period_ms() const { return period_ms_; }
  double peak_tension() const { return peak_tension_kPa_; }  ///< kPa
  /// Begin and end of contraction (a > 0) within a period; τ rises from the first and is largest at the
  /// second.
  double contraction_begin_ms() const { return begin_ms_; }
  double contraction_end_ms() const { return end_ms_; }

 private:
  struct Piece {
    double spacing_ms = 0;
    std::vector<Sample> nodes;  ///< equidistant
  };

  double period_ms_, begin_ms_ = 0, end_ms_ = 0, peak_tension_kPa_ = 0;
  Piece contraction_, relaxation_;  ///< one after the other, from begin_ms_ on
};

}  // namespace cardiac
