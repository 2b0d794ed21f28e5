#pragma once

#include <cardiac/contraction/calcium.hpp>
#include <cardiac/contraction/sarcomere.hpp>

namespace cardiac {

/// Parameters of Land et al. 2017 (human, 37 °C); rates in 1/ms.
struct LandParameters {
  double reference_tension_kPa = 120;  ///< T_ref
  double calcium_50_uM = 0.805;        ///< Ca₅₀ at λ = 1
  double overlap_slope = 2.3;          ///< β₀
  double calcium_slope_uM = -2.4;      ///< β₁
  double r_s = 0.25, r_w = 0.5;        ///< duty ratios in steady state
  double k_uw = 0.182, k_ws = 0.012;
  double gamma_s = 0.0085, gamma_w = 0.615;
  double phi = 2.23, A_eff = 25;
  double TRPN_50 = 0.35, n_TRPN = 2, k_TRPN = 0.1;
  double k_u = 1, n_Tm = 5;
  double time_factor = 1;  ///< on all times: rates are divided by it
  CalciumTransient calcium{};
};

/// The model of Land, Park-Holohan, Smith, dos Remedios, Kentish and Niederer 2017 of human cardiac muscle:
/// troponin binds calcium, tropomyosin unblocks, cross-bridges are weak (W) or strong (S), with mean
/// distortions ζ:
///   dCaTRPN/dt = k_TRPN ((Ca/Ca₅₀(λ))^n_TRPN (1 − CaTRPN) − CaTRPN),  Ca₅₀(λ) = Ca₅₀ + β₁ (min(λ, 1.2) − 1),
///   dB/dt = k_b CaTRPN^(−n_Tm/2) U − k_u CaTRPN^(n_Tm/2) B,  U = 1 − B − S − W,
///   dW/dt = k_uw U − k_wu W − k_ws W − γ_wu W,  dS/dt = k_ws W − k_su S − γ_su S,
///   dζ_i/dt = A λ̇ − c_i ζ_i,
///   T = h(λ) T_ref/r_s (S (ζ_s + 1) + W ζ_w).
/// States: CaTRPN, B, W, S, ζ_w, ζ_s. The viscoelastic passive part of the paper is the tissue's.
class Land2017 : public SarcomereModel {
 public:
  /// Throws InputError for a parameter that is not positive.
  explicit Land2017(const LandParameters& parameters);
  int num_states() const override { return 6; }
  double period_ms() const override { return p_.calcium.period_ms; }
  double drive(double since_ms) const override { return p_.calcium.at(since_ms); }  ///< Ca, µM
  void respond(const FibreMotion& at, const States& z, bool derivatives, SarcomereResponse& r) const override;
  States at_rest(double drive, double stretch) const override;

 private:
  LandParameters p_;
  double k_wu_, k_su_, k_b_, A_, c_w_, c_s_;
};

}  // namespace cardiac
