#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <memory>

#include <cardiac/anatomy/coordinates.hpp>
#include <polyaffine/vtk/read.hpp>

namespace cardiac::testing {

/// The coarse mesh of Land's ellipsoid (semi-axes 7 to 10 and 17 to 20 mm, apex at −z, base at z = 5 mm) and
/// its coordinates, made once a test program.
struct LandEllipsoid {
  polyaffine::TetMesh mesh = polyaffine::read_vtu(PROJECT_DIR "/meshes/land_ellipsoid_coarse.vtu", 1);
  std::shared_ptr<const VentricularCoordinates> coordinates =
      std::make_shared<VentricularCoordinates>(mesh, SurfaceLabels{}, AnatomyOptions{});

  static const LandEllipsoid& get() {
    static const LandEllipsoid ellipsoid;
    return ellipsoid;
  }
};

/// Depth t of the ellipsoid with semi-axes 7 + 3t and 17 + 3t mm through a point.
inline double analytic_depth(const polyaffine::Vec3& X) {
  double low = -0.5;
  double high = 1.5;
  while (high - low > 1e-12) {
    const double t = (low + high) / 2;
    const double s = 7 + 3 * t;
    const double l = 17 + 3 * t;
    ((X.x() * X.x() + X.y() * X.y()) / (s * s) + X.z() * X.z() / (l * l) > 1 ? low : high) = t;
  }
  return low;
}

/// Columns longitudinal, circumferential, radial at a point of the ellipsoid through it, off the axis: the
/// radial one its normal, the circumferential one counter-clockwise seen from the base.
inline polyaffine::Mat3 analytic_axes(const polyaffine::Vec3& X) {
  const double t = analytic_depth(X);
  const double s2 = std::pow(7 + 3 * t, 2);
  const double l2 = std::pow(17 + 3 * t, 2);
  const polyaffine::Vec3 r = polyaffine::Vec3(X.x() / s2, X.y() / s2, X.z() / l2).normalized();
  const polyaffine::Vec3 c = polyaffine::Vec3(-X.y(), X.x(), 0).normalized();
  polyaffine::Mat3 out;
  out << r.cross(c), c, r;
  return out;
}

}  // namespace cardiac::testing
