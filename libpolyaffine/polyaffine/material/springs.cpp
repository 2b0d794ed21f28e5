#include "polyaffine/material/springs.hpp"

#include <polyaffine/material/parameters.hpp>

namespace polyaffine {

SurfaceSpring::SurfaceSpring(double stiffness) : stiffness_(stiffness) {
  require_positive("spring stiffness", stiffness, "kPa/mm");
}

SurfaceSpring::SurfaceSpring(double stiffness, Points normals, SpringDirection direction)
    : SurfaceSpring(stiffness) {
  normals_ = std::move(normals);
  direction_ = direction;
}

void SurfaceSpring::respond(PackPoints points, const PackMotion& at, bool tangent, PackResponse& r) const {
  const Mat3Pack& M = at.F;
  const bool has_normals = normals_.size() > 0, across = direction_ == SpringDirection::across_normal;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      Pack k = broadcast(i == j ? stiffness_ : 0);
      if (has_normals) {
        const double* n = normals_.data() + 3 * static_cast<std::ptrdiff_t>(points.point);
        const Pack along = stiffness_ * gather(n + i, 3, points.lanes) * gather(n + j, 3, points.lanes);
        k = across ? k - along : along;
      }
      r.P[i] += k * M.m[j];
      if (tangent && j <= i) r.A[i][j] = k;
    }
    r.W += 0.5 * M.m[i] * r.P[i];
  }
}

MeanMotionSpring::MeanMotionSpring(double stiffness, const Vec3& normal, double arm)
    : stiffness_(stiffness), arm_(arm), normal_(normal) {
  require_positive("spring stiffness", stiffness, "mN/mm");
}

void MeanMotionSpring::respond(PackPoints, const PackMotion& at, bool tangent, PackResponse& r) const {
  const Mat3 along = normal_ * normal_.transpose();
  const Mat3 stiffness[2] = {stiffness_ * (Mat3::Identity() - along), stiffness_ * arm_ * arm_ * along};
  for (int part = 0; part < 2; ++part)
    for (int i = 0; i < 3; ++i) {
      const int row = 3 * part + i;
      for (int j = 0; j < 3; ++j) {
        r.P[row] += stiffness[part](i, j) * at.F.m[3 * part + j];
        if (tangent && j <= i) r.A[row][3 * part + j] += broadcast(stiffness[part](i, j));
      }
      r.W += 0.5 * at.F.m[row] * r.P[row];
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
