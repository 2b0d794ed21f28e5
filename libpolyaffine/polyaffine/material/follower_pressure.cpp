#include <polyaffine/material/follower_pressure.hpp>

namespace polyaffine {

void FollowerPressure::respond(PackPoints, const PackMotion& at, bool tangent, PackResponse& r) const {
  const Mat3Pack& M = at.F;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    r.P[i] += M(j, 1) * M(k, 2) - M(k, 1) * M(j, 2);
    if (!tangent) continue;
    r.A[3 + j][i] += 0.5 * M(k, 2);
    r.A[3 + k][i] -= 0.5 * M(j, 2);
    r.A[6 + k][i] += 0.5 * M(j, 1);
    r.A[6 + j][i] -= 0.5 * M(k, 1);
  }
}

}  // namespace polyaffine
