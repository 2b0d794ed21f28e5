#pragma once

#include <cardiac/contraction/bestel_2001.hpp>
#include <cardiac/contraction/sarcomere.hpp>

namespace cardiac {

/// Beside BestelParameters; values of Genet, Diaz, Chapelle and Moireau 2023.
struct BridgeParameters {
  double bridge_stiffness_kPa = 260;  ///< k₀
  double series_stiffness_kPa = 1e5;  ///< k_s
  double viscosity_kPa_ms = 70;       ///< µ
  double rate_destruction = 12;       ///< α
  double overlap_slope = 2.3;  ///< β₀ of n₀(λ) = filament_overlap, which that of the paper stands for
};

/// The contraction of Bestel, Clément and Sorine 2001 in full: cross-bridges of stress τ_c and stiffness k_c
/// beside a dashpot µ, in series with a spring k_s. With e = λ − 1, its part e_c and the activation ν(t) = a
/// of BestelParameters,
///   µ ė_c = k_s (e − e_c) − τ_c,
///   τ̇_c = −(|ν| + α |ė_c|) τ_c + k_c ė_c + n₀ σ₀ max(ν, 0),
///   k̇_c = −(|ν| + α |ė_c|) k_c + n₀ k₀ max(ν, 0),
///   T = k_s (e − e_c), so that the second Piola–Kirchhoff stress is (τ_c + µ ė_c)/(1 + e).
/// States: x = k_s (e − e_c)/σ₀, τ_c/σ₀, k_c/k₀; n₀ is taken at 1 + e_c. Source also: Chapelle et al. 2012.
class BestelFull2001 : public SarcomereModel {
 public:
  /// Throws as check_contraction.
  BestelFull2001(const BestelParameters& contraction, const BridgeParameters& bridges, double period_ms);
  int num_states() const override { return 3; }
  double period_ms() const override { return period_ms_; }
  double drive(double since_ms) const override;  ///< ν, 1/ms
  void respond(const FibreMotion& at, const States& z, bool derivatives, SarcomereResponse& r) const override;
  States at_rest(double drive, double stretch) const override;

 private:
  BestelParameters p_;
  BridgeParameters b_;
  double period_ms_;
};

}  // namespace cardiac
