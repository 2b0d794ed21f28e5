#pragma once

#include <polyaffine/material/law.hpp>
#include <polyaffine/material/parameters.hpp>

namespace polyaffine {

/// Constants of the Mooney–Rivlin solid; its small-strain shear modulus is 2 (c1 + c2).
struct MooneyRivlinParameters {
  double c1;  ///< kPa, ≥ 0
  double c2;  ///< kPa, ≥ 0
};

/// Isochoric part of the Mooney–Rivlin solid, W = c1 (Ī₁ − 3) + c2 (Ī₂ − 3) with the invariants of
/// C̄ = J^(−2/3) C (Holzapfel 2000, eq. 6.147). Add a volumetric law.
class MooneyRivlin : public Law {
 public:
  /// `factor` multiplies W (one per point, empty = 1). Throws InputError for a negative constant, or when
  /// both are zero.
  explicit MooneyRivlin(MooneyRivlinParameters parameters, std::vector<double> factor = {});
  void respond(PackPoints points, const PackMotion& at, bool tangent, PackResponse& r) const override;

 private:
  MooneyRivlinParameters parameters_;
  StiffnessFactor factor_;
};

}  // namespace polyaffine
