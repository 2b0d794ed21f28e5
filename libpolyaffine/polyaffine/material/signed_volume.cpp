#include <polyaffine/material/signed_volume.hpp>
#include <polyaffine/material/volumetric_response.hpp>

namespace polyaffine {

void SignedVolume::respond(PackPoints, const PackMotion& at, bool tangent, PackResponse& r) const {
  const Mat3Pack& m = at.F;
  const Mat3Pack cof = cofactor(m);
  add_volumetric(m, cof, {scale_ * determinant(m, cof), broadcast(scale_), broadcast(0)}, tangent, r);
}

}  // namespace polyaffine
