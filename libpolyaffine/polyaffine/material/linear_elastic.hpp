#pragma once

#include <polyaffine/material/law.hpp>
#include <polyaffine/material/parameters.hpp>

namespace polyaffine {

/// Linear elasticity at small strain, W = μ ε:ε + λ/2 (tr ε)², ε = (F + Fᵀ)/2 − I. Not objective: a finite
/// rotation costs energy.
class LinearElastic : public Law {
 public:
  /// E in kPa and ν, times `factor` (one per point, empty = 1). Throws InputError as `lame` does.
  explicit LinearElastic(const Elasticity& elasticity, std::vector<double> factor = {});
  void respond(PackPoints points, const PackMotion& at, bool tangent, PackResponse& r) const override;

 private:
  Lame lame_;
  StiffnessFactor factor_;
};

}  // namespace polyaffine
