#pragma once

#include <cardiac/tissue/fibre_axes.hpp>
#include <polyaffine/material/law.hpp>

namespace cardiac {

/// Active tension of the fibres as a force over the reference area (nominal stress):
///   P = T (∂λ_f/∂F + n_c (∂λ_s/∂F + ∂λ_n/∂F)),  λ_a = |F a|,  W = T (λ_f − 1 + n_c (λ_s + λ_n − 2)),
/// so that its power is T λ̇_f without the part across. The state holds T (kPa) of all points and behind them
/// the change κ of T with the stretch of the fibre (kPa), which the tangent has beside T ∂²λ/∂F²:
///   κ (∂λ_f ⊗ ∂λ_f + ½ n_c (∂λ_f ⊗ (∂λ_s + ∂λ_n) + (∂λ_s + ∂λ_n) ⊗ ∂λ_f)),
/// symmetric as a LinearSystem wants it, and exact for n_c = 0.
class FibreTension : public polyaffine::Law {
 public:
  /// Throws InputError for axes that are not orthonormal and n_c outside of [0, 1].
  explicit FibreTension(const FibreAxes& axes, double cross_fibre_fraction = 0);
  /// Throws ComputationError where the state does not hold two numbers a point.
  void respond(polyaffine::PackPoints points, const polyaffine::PackMotion& at, bool tangent,
               polyaffine::PackResponse& r) const override;

 private:
  FibrePacks axes_;
  double cross_fibre_fraction_;
};

}  // namespace cardiac
