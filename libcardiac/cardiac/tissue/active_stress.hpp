#pragma once

#include <cardiac/tissue/fibre_axes.hpp>
#include <polyaffine/material/law.hpp>

namespace cardiac {

/// Active tension of the fibres as a second Piola–Kirchhoff stress that is added as it is (Land et al. 2015,
/// Aróstica et al. 2025):
///   S = τ (f⊗f + n_c (s⊗s + n⊗n)),  W = τ/2 (C:f⊗f − 1 + n_c (C:(s⊗s + n⊗n) − 2)),
/// with τ in kPa read from the state of the point and held fixed when differentiating. A state of twice as
/// many numbers as there are points holds behind the tensions their change κ = dτ/dλ (kPa) with the stretch λ
/// of the fibre; the tangent then has beside δ_ik S_JL the symmetric part of κ F(f⊗f + n_c (s⊗s + n⊗n)) ⊗
/// ∂λ/∂F, which is all of it for n_c = 0.
class ActiveStress : public polyaffine::Law {
 public:
  /// `cross_fibre_fraction` n_c, dimensionless, 0 to 1. Throws InputError, also for axes that are not
  /// orthonormal.
  explicit ActiveStress(const FibreAxes& axes, double cross_fibre_fraction = 0);
  /// Throws ComputationError when `tension_kPa` has none for one of the points.
  void respond(polyaffine::PackPoints points, const polyaffine::PackMotion& at, bool tangent,
               polyaffine::PackResponse& r) const override;
  bool feels_state() const override { return true; }

 private:
  void add_change(polyaffine::PackPoints points, const polyaffine::PackMotion& at,
                  polyaffine::PackResponse& r) const;

  FibrePacks axes_;
  double cross_fibre_fraction_;
};

}  // namespace cardiac
