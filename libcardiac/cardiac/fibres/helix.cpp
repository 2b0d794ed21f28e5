#include "cardiac/fibres/helix.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include <cardiac/anatomy/right_ventricle.hpp>

namespace cardiac {

using polyaffine::Mat3;
using polyaffine::Vec3;

namespace {

// Spherical interpolation; half turns about f, s or n leave the tissue as it is.
Mat3 blend(const Mat3& from, const Mat3& to, double share) {
  using Quaternion = Eigen::Quaterniond;
  const Quaternion a(from), b(to);
  Quaternion nearest = a;
  for (const Quaternion& turn : {Quaternion(0, 1, 0, 0), Quaternion(0, 0, 1, 0), Quaternion(0, 0, 0, 1)})
    if (const Quaternion turned = a * turn; std::abs(turned.dot(b)) > std::abs(nearest.dot(b)))
      nearest = turned;
  return nearest.slerp(share, b).normalized().toRotationMatrix();
}

}  // namespace

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

Mat3 wall_fibres(const VentricularCoordinates& coordinates, int tet, const polyaffine::Vec4& barycentric,
                 const HelixAngles& angles) {
  const double share = coordinates.right() ? coordinates.right()->border(tet, barycentric).share : 0;
  if (share == 0) return helix_axes(coordinates.sample(tet, barycentric), angles);
  HelixAngles right = angles;
  right.endo_deg = angles.rv_endo_deg;
  right.epi_deg = angles.rv_epi_deg;
  const Mat3 there = helix_axes(coordinates.right_sample(tet, barycentric), right);
  if (share == 1) return there;
  return blend(helix_axes(coordinates.sample(tet, barycentric), angles), there, share);
}

FibreAxes helix_fibres(const VentricularCoordinates& coordinates, const std::vector<int>& tet,
                       const Eigen::Matrix4Xd& barycentric, const HelixAngles& angles) {
  FibreAxes out(9, barycentric.cols());
  for (Eigen::Index q = 0; q < barycentric.cols(); ++q)
    out.col(q) = wall_fibres(coordinates, tet[q], barycentric.col(q), angles).reshaped();
  return out;
}

}  // namespace cardiac
