#pragma once

#include <polyaffine/material/law.hpp>
#include <polyaffine/material/parameters.hpp>

namespace polyaffine {

/// Kelvin–Voigt viscosity, S = η Ė with Ė = sym(FᵀḞ), the rate of Green–Lagrange strain: no stress in a rigid
/// motion. Dissipates η Ė:Ė per reference volume and time; it has no energy.
class KelvinVoigt : public Law {
 public:
  /// `viscosity` η in kPa·ms, ≥ 0, times `factor` (one per point, empty = 1). Throws InputError.
  explicit KelvinVoigt(double viscosity, std::vector<double> factor = {});

  /// P = F S (kPa) and, of the tangent, the part by the rate, ∂P_iJ/∂Ḟ_kL = η/2 (F_iM F_kM δ_JL + F_iL F_kJ),
  /// which is symmetric, times the rate factor; that by F itself is left out, since it vanishes with the
  /// step. Nothing where nothing moves.
  void respond(PackPoints points, const PackMotion& at, bool tangent, PackResponse& r) const override;
  bool feels_rate() const override { return true; }

  using Law::evaluate;
  /// Adds, for `count` points laid out as in Law::evaluate (null outputs are skipped),
  ///   P, A_dot = ∂P_iJ/∂Ḟ_kL as above                               (9 and 81 a point, kPa and kPa·ms),
  ///   A = ∂P_iJ/∂F_kL at fixed Ḟ
  ///     = δ_ik S_JL + η/2 (F_iM Ḟ_kM δ_JL + F_iL Ḟ_kJ)               (81 a point, kPa, not symmetric),
  /// from the deformation gradient F and its rate Ḟ in 1/ms.
  void evaluate(int first, int count, const double* F, const double* F_dot, double* P, double* A_dot,
                double* A = nullptr) const;

 private:
  double viscosity_;
  StiffnessFactor factor_;
};

}  // namespace polyaffine
