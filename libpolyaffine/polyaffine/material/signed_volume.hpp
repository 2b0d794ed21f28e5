#pragma once

#include <polyaffine/material/law.hpp>

namespace polyaffine {

/// W = s det M: a signed volume written as a law, so that a cavity is an energy over points of its surface.
/// With M = [x, x_ξ, x_η] and weights that integrate over the parameters ξ, η, s = 1/3 gives the volume
/// between the surface and the origin, ⅓ ∫ x·n da. The
/// unit of W is that of det M.
class SignedVolume : public Law {
 public:
  explicit SignedVolume(double scale) : scale_(scale) {}
  void respond(PackPoints points, const PackMotion& at, bool tangent, PackResponse& r) const override;

 private:
  double scale_;
};

}  // namespace polyaffine
