#pragma once

#include <vector>

#include <cardiac/tissue/fibre_axes.hpp>
#include <polyaffine/material/law.hpp>
#include <polyaffine/material/parameters.hpp>

namespace cardiac {

/// Constants of Guccione's law.
struct GuccioneParameters {
  double C_kPa;           ///< stiffness, kPa, > 0
  double bf, bt, bfs;     ///< exponents along fibres, across them, in fibre shear; dimensionless, ≥ 0
  bool isochoric = true;  ///< strain of C̄ = J^(−2/3) C (nearly incompressible use) instead of C
};

/// Transversely isotropic passive tissue (Guccione et al. 1991, as in Land et al. 2015):
///   W = C/2 (e^Q − 1),
///   Q = bf E_ff² + bt (E_ss² + E_nn² + 2 E_sn²) + 2 bfs (E_fs² + E_fn²), E in the axes f, s, n.
/// It has no volumetric part: add a volumetric law.
class Guccione : public polyaffine::Law {
 public:
  /// `factor` multiplies W (one per point, empty = 1). Throws InputError for impossible constants, axes that
  /// are not orthonormal or a number of factors other than that of the axes.
  Guccione(GuccioneParameters parameters, const FibreAxes& axes, std::vector<double> factor = {});
  void respond(polyaffine::PackPoints points, const polyaffine::PackMotion& at, bool tangent,
               polyaffine::PackResponse& r) const override;

 private:
  GuccioneParameters parameters_;
  FibrePacks axes_;
  polyaffine::StiffnessFactor factor_;
};

}  // namespace cardiac
