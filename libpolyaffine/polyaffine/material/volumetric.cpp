#include <utility>

#include <polyaffine/material/volumetric.hpp>
#include <polyaffine/material/volumetric_response.hpp>

namespace polyaffine {

QuadraticVolumetric::QuadraticVolumetric(double bulk_modulus, std::vector<double> factor)
    : bulk_modulus_(bulk_modulus), factor_(std::move(factor)) {
  require_positive("bulk modulus", bulk_modulus, "kPa");
}

void QuadraticVolumetric::respond(PackPoints points, const PackMotion& at, bool tangent,
                                  PackResponse& r) const {
  const Mat3Pack& f = at.F;
  const Mat3Pack cof = cofactor(f);
  const Pack dJ = determinant(f, cof) - 1;
  const Pack kappa = broadcast(bulk_modulus_);
  add_volumetric(f, cof, {0.5 * kappa * dJ * dJ, kappa * dJ, kappa}, tangent, r);
  factor_.apply(points, tangent, r);
}

LogarithmicVolumetric::LogarithmicVolumetric(double bulk_modulus, std::vector<double> factor)
    : bulk_modulus_(bulk_modulus), factor_(std::move(factor)) {
  require_positive("bulk modulus", bulk_modulus, "kPa");
}

void LogarithmicVolumetric::respond(PackPoints points, const PackMotion& at, bool tangent,
                                    PackResponse& r) const {
  const Mat3Pack& f = at.F;
  const Mat3Pack cof = cofactor(f);
  const Pack J = determinant(f, cof), inverse = 1 / J;
  const double kappa = bulk_modulus_;
  add_volumetric(f, cof,
                 {0.25 * kappa * (J * J - 1 - 2 * log(J)), 0.5 * kappa * (J - inverse),
                  0.5 * kappa * (1 + inverse * inverse)},
                 tangent, r);
  factor_.apply(points, tangent, r);
}

}  // namespace polyaffine
