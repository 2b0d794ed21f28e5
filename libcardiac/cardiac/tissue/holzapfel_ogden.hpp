#pragma once

#include <vector>

#include <cardiac/tissue/fibre_axes.hpp>
#include <polyaffine/material/law.hpp>
#include <polyaffine/material/parameters.hpp>

namespace cardiac {

/// Constants of the Holzapfel–Ogden law: stiffnesses in kPa, ≥ 0 (a > 0); exponents dimensionless, > 0. The
/// defaults are those of Aróstica et al. 2025.
struct HolzapfelOgdenParameters {
  double a_kPa = 0.059, b = 8.023;
  double a_f_kPa = 18.472, b_f = 16.026;
  double a_s_kPa = 2.481, b_s = 11.12;
  double a_fs_kPa = 0.216, b_fs = 11.436;
  double switch_steepness = 100;  ///< k of the fibre switch, dimensionless, ≥ 0
};

/// Orthotropic passive tissue (Holzapfel & Ogden 2009, in the form of Aróstica et al. 2025):
///   W = a/2b (e^{b(Ī₁−3)} − 1) + Σ_{i=f,s} a_i/2b_i χ(I₄ᵢ)(e^{b_i(I₄ᵢ−1)²} − 1) + a_fs/2b_fs (e^{b_fs I₈²} −
///   1), χ(I₄) = 1/(1 + e^{−k(I₄−1)}).
/// Ī₁ = J^(−2/3) tr C is isochoric, I₄f = f·Cf, I₄s = s·Cs and I₈ = f·Cs are not. The switch χ multiplies the
/// *energy*, as in the benchmark's energy function; stress and tangent contain its derivatives, which makes
/// the energy slightly non-convex around I₄ ≈ 1 − 1/k. There is no volumetric part: add a volumetric law.
class HolzapfelOgden : public polyaffine::Law {
 public:
  /// `factor` multiplies W (one per point, empty = 1). Throws InputError for impossible constants, axes that
  /// are not orthonormal or a number of factors other than that of the axes.
  HolzapfelOgden(HolzapfelOgdenParameters parameters, const FibreAxes& axes, std::vector<double> factor = {});
  void respond(polyaffine::PackPoints points, const polyaffine::PackMotion& at, bool tangent,
               polyaffine::PackResponse& r) const override;

 private:
  HolzapfelOgdenParameters parameters_;
  FibrePacks axes_;
  polyaffine::StiffnessFactor factor_;
};

}  // namespace cardiac
