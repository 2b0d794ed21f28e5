#include <polyaffine/material/signed_volume.hpp>
#include <polyaffine/material/volumetric_response.hpp>

namespace polyaffine {

void SignedVolume::evaluate(int first, int count, const double* M, PointState, double* W, double* P,
                            double* A) const {
  evaluate_packed(
      first, count, M, W, P, A, [this](PackPoints, const Mat3Pack& m, bool tangent, PackResponse& r) {
        const Mat3Pack cof = cofactor(m);
        add_volumetric(m, cof, {scale_ * determinant(m, cof), broadcast(scale_), broadcast(0)}, tangent, r);
      });
}

}  // namespace polyaffine
