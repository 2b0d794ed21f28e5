#pragma once

#include <polyaffine/material/law.hpp>
#include <polyaffine/material/parameters.hpp>

namespace polyaffine {

/// Compressible neo-Hookean solid, W = μ/2 (I₁ − 3) − μ ln J + λ/2 (ln J)² (Bonet & Wood 1997).
class NeoHookean : public Law {
 public:
  /// `lame` λ ≥ 0 and μ > 0 in kPa (from E and ν: `lame({E, nu})`), times `factor` (one per point,
  /// empty = 1). Throws InputError.
  explicit NeoHookean(Lame lame, std::vector<double> factor = {});
  void respond(PackPoints points, const PackMotion& at, bool tangent, PackResponse& r) const override;

 private:
  Lame lame_;
  StiffnessFactor factor_;
};

/// Isochoric neo-Hookean part, W = μ/2 (Ī₁ − 3), Ī₁ = J^(−2/3) tr C. Together with a volumetric law it is the
/// nearly incompressible neo-Hookean solid; with QuadraticVolumetric of κ = λ + ⅔ μ its small-strain limit is
/// linear elasticity with λ and μ.
class IsochoricNeoHookean : public Law {
 public:
  /// `shear_modulus` μ in kPa, > 0, times `factor` (one per point, empty = 1). Throws InputError.
  explicit IsochoricNeoHookean(double shear_modulus, std::vector<double> factor = {});
  void respond(PackPoints points, const PackMotion& at, bool tangent, PackResponse& r) const override;

 private:
  double shear_modulus_;
  StiffnessFactor factor_;
};

}  // namespace polyaffine
