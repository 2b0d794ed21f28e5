#include "cardiac/fibres/helix.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace cardiac {

using polyaffine::Mat3;
using polyaffine::Vec3;

Mat3 orthonormal_axes(const CoordinateSample& at) {
  const Vec3 r = at.Q.col(2).normalized();
  const Vec3 c = (at.Q.col(1) - at.Q.col(1).dot(r) * r).normalized();
  Mat3 axes;
  axes << r.cross(c), c, r;
  return axes;
}

Mat3 helix_axes(const CoordinateSample& at, const HelixAngles& angles) {
  constexpr double kRadian = polyaffine::kPi / 180;
  const Mat3 axes = orthonormal_axes(at);
  const double alpha = kRadian * (angles.endo_deg + at.t * (angles.epi_deg - angles.endo_deg));
  const Vec3 f = std::cos(alpha) * axes.col(1) + std::sin(alpha) * axes.col(0);
  const double beta = kRadian * angles.sheet_deg;
  const Vec3 s = std::cos(beta) * axes.col(2) + std::sin(beta) * f.cross(axes.col(2));
  Mat3 out;
  out << f, s, f.cross(s);
  return out;
}

FibreAxes helix_fibres(const VentricularCoordinates& coordinates, const std::vector<int>& tet,
                       const Eigen::Matrix4Xd& barycentric, const HelixAngles& angles) {
  FibreAxes out(9, barycentric.cols());
  for (Eigen::Index q = 0; q < barycentric.cols(); ++q)
    out.col(q) = helix_axes(coordinates.sample(tet[q], barycentric.col(q)), angles).reshaped();
  return out;
}

}  // namespace cardiac
