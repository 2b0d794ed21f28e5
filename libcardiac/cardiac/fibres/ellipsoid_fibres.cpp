#include "cardiac/fibres/ellipsoid_fibres.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include <polyaffine/core/error.hpp>

namespace cardiac {

// r²/r_s² + z²/r_l² falls with t and is convex: Newton's method from the left, where it is at least 1, rises
// to the root.
double ellipsoid_depth(const TruncatedEllipsoid& shape, const Vec3& X) {
  const double ds = shape.epi_short_mm - shape.endo_short_mm;
  const double dl = shape.epi_long_mm - shape.endo_long_mm;
  const double r = std::hypot(X.x(), X.y());
  const double z = std::abs(X.z());
  double t = std::max((r - shape.endo_short_mm) / ds, (z - shape.endo_long_mm) / dl);
  for (int i = 0; i < 100; ++i) {
    const double s = shape.endo_short_mm + t * ds;
    const double l = shape.endo_long_mm + t * dl;
    if (!(s > 0 && l > 0)) break;
    const double a = r * r / (s * s);
    const double b = z * z / (l * l);
    const double step = (a + b - 1) / (2 * (a * ds / s + b * dl / l));
    t += step;
    if (!(std::abs(step) > 1e-14 * (1 + std::abs(t)))) return t;
  }
  throw polyaffine::InputError("depth in the ellipsoidal wall: found the point (" + std::to_string(X.x()) +
                               ", " + std::to_string(X.y()) + ", " + std::to_string(X.z()) +
                               ") mm, expected one that an ellipsoid of the family passes through");
}

CoordinateSample ellipsoid_sample(const TruncatedEllipsoid& shape, const Vec3& X) {
  CoordinateSample out;
  out.t = ellipsoid_depth(shape, X);
  const double s = shape.endo_short_mm + out.t * (shape.epi_short_mm - shape.endo_short_mm);
  const double l = shape.endo_long_mm + out.t * (shape.epi_long_mm - shape.endo_long_mm);
  const double r = std::hypot(X.x(), X.y());
  const Vec3 c = r > 0 ? Vec3(-X.y() / r, X.x() / r, 0) : Vec3::UnitY();
  const Vec3 normal = Vec3(X.x() / (s * s), X.y() / (s * s), X.z() / (l * l)).normalized();
  out.Q << normal.cross(c), c, normal;
  return out;
}

FibreAxes ellipsoid_fibres(const TruncatedEllipsoid& shape, const HelixAngles& angles, const Points& X) {
  FibreAxes out(9, X.cols());
  for (Eigen::Index q = 0; q < X.cols(); ++q)
    out.col(q) = helix_axes(ellipsoid_sample(shape, X.col(q)), angles).reshaped();
  return out;
}

}  // namespace cardiac
