#include "polyaffine/material/springs.hpp"

#include <polyaffine/material/parameters.hpp>

namespace polyaffine {

SurfaceSpring::SurfaceSpring(double stiffness) : stiffness_(stiffness) {
  require_positive("spring stiffness", stiffness, "kPa/mm");
}

SurfaceSpring::SurfaceSpring(double stiffness, Points normals) : SurfaceSpring(stiffness) {
  normals_ = std::move(normals);
}

void SurfaceSpring::respond(PackPoints points, const PackMotion& at, bool tangent, PackResponse& r) const {
  const Mat3Pack& M = at.F;
  const bool along_normal = normals_.size() > 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      Pack k = broadcast(i == j ? stiffness_ : 0);
      if (along_normal) {
        const double* n = normals_.data() + 3 * static_cast<std::ptrdiff_t>(points.point);
        k = stiffness_ * gather(n + i, 3, points.lanes) * gather(n + j, 3, points.lanes);
      }
      r.P[i] += k * M.m[j];
      if (tangent && j <= i) r.A[i][j] = k;
    }
    r.W += 0.5 * M.m[i] * r.P[i];
  }
}

void DeadTraction::respond(PackPoints, const PackMotion& at, bool, PackResponse& r) const {
  const Mat3Pack& M = at.F;
  for (int i = 0; i < 3; ++i) {
    r.W -= traction_[i] * M.m[i];
    r.P[i] = broadcast(-traction_[i]);
  }
}

}  // namespace polyaffine
