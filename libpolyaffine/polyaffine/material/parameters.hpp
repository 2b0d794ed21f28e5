#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include <polyaffine/material/batch.hpp>

namespace polyaffine {

/// The two constants of an isotropic elastic material at small strain.
struct Elasticity {
  double young;    ///< E, kPa, > 0
  double poisson;  ///< ν, dimensionless, −1 < ν < 1/2
};

/// Lamé's constants, kPa.
struct Lame {
  double lambda;
  double mu;
};

/// λ = E ν / ((1+ν)(1−2ν)), μ = E / (2(1+ν)). Throws InputError unless E > 0 and −1 < ν < 1/2.
Lame lame(const Elasticity& elasticity);

/// Throws InputError("NAME: found VALUE, expected EXPECTED") when `ok` is false.
void require(bool ok, std::string_view name, double value, std::string_view expected);

/// A finite number > 0, respectively ≥ 0, or InputError.
void require_positive(std::string_view name, double value, std::string_view unit);
void require_not_negative(std::string_view name, double value, std::string_view unit);

/// A factor ≥ 0 on the stiffness of each point; empty means 1 everywhere. Throws InputError otherwise.
class StiffnessFactor {
 public:
  explicit StiffnessFactor(std::vector<double> values);
  /// InputError unless empty or one factor for each of `points`.
  void require_size(std::ptrdiff_t points) const;
  [[gnu::always_inline]] Pack at(PackPoints points) const {
    return values_.empty() ? broadcast(1) : gather(values_.data() + points.point, 1, points.lanes);
  }
  void apply(PackPoints points, bool tangent, PackResponse& r) const {
    if (!values_.empty()) scale(at(points), tangent, r);
  }

 private:
  std::vector<double> values_;
};

}  // namespace polyaffine
