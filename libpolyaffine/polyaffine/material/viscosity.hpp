#pragma once

#include <polyaffine/material/parameters.hpp>

namespace polyaffine {

/// Kelvin–Voigt viscosity, S = η Ė with Ė = sym(FᵀḞ), the rate of Green–Lagrange strain: no stress in a rigid
/// motion. Dissipates η Ė:Ė per reference volume and time.
class KelvinVoigt {
 public:
  /// `viscosity` η in kPa·ms, ≥ 0, times `factor` (one per point, empty = 1). Throws InputError.
  explicit KelvinVoigt(double viscosity, std::vector<double> factor = {});

  /// Adds to the response of one pack of points P = F S (kPa) and, with `tangent`, `rate_factor` (1/ms) times
  /// ∂P_iJ/∂Ḟ_kL = η/2 (F_iM F_kM δ_JL + F_iL F_kJ), which is symmetric; Ḟ in 1/ms.
  void respond(PackPoints points, const Mat3Pack& F, const Mat3Pack& F_dot, double rate_factor, bool tangent,
               PackResponse& r) const;

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
