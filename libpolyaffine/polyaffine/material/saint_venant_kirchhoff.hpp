#pragma once

#include <polyaffine/material/law.hpp>
#include <polyaffine/material/parameters.hpp>

namespace polyaffine {

/// St Venant–Kirchhoff solid, W = μ E:E + λ/2 (tr E)², E = (FᵀF − I)/2. For large rotations at moderate
/// strain: in strong compression it softens and loses its resistance.
class SaintVenantKirchhoff : public Law {
 public:
  /// E in kPa and ν, times `factor` (one per point, empty = 1). Throws InputError as `lame` does.
  explicit SaintVenantKirchhoff(const Elasticity& elasticity, std::vector<double> factor = {});
  void respond(PackPoints points, const PackMotion& at, bool tangent, PackResponse& r) const override;

 private:
  Lame lame_;
  StiffnessFactor factor_;
};

}  // namespace polyaffine
