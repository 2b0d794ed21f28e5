#pragma once

#include <polyaffine/material/law.hpp>
#include <polyaffine/material/parameters.hpp>

namespace polyaffine {

/// W = κ/2 (J − 1)², J = det F.
class QuadraticVolumetric : public Law {
 public:
  /// `bulk_modulus` κ in kPa, > 0, times `factor` (one per point, empty = 1). Throws InputError.
  explicit QuadraticVolumetric(double bulk_modulus, std::vector<double> factor = {});
  void respond(PackPoints points, const PackMotion& at, bool tangent, PackResponse& r) const override;

 private:
  double bulk_modulus_;
  StiffnessFactor factor_;
};

/// W = κ/4 (J² − 1 − 2 ln J): the same small-strain bulk modulus, and infinite energy at J = 0
/// (Ogden 1972 family; used by Aróstica et al. 2025).
class LogarithmicVolumetric : public Law {
 public:
  /// `bulk_modulus` κ in kPa, > 0, times `factor` (one per point, empty = 1). Throws InputError.
  explicit LogarithmicVolumetric(double bulk_modulus, std::vector<double> factor = {});
  void respond(PackPoints points, const PackMotion& at, bool tangent, PackResponse& r) const override;

 private:
  double bulk_modulus_;
  StiffnessFactor factor_;
};

}  // namespace polyaffine
