#include "cardiac/anatomy/idealised.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <polyaffine/core/error.hpp>

namespace cardiac {
namespace {

using polyaffine::kPi;

double cap_volume(double a, double c, double z) {
  return kPi * a * a * (2 * c / 3 + z - z * z * z / (3 * c * c));
}

double rim_radius(double a, double c, double z) {
  return a * std::sqrt(1 - z * z / (c * c));
}

/// Nearest point for x on the axis (a ≤ c) or in the plane z = 0 (a > c) so near the centre that all points
/// around the axis, or above and below the plane, are as near; takes one of them.
Vec3 from_focal_set(double a, double c, const Vec3& x) {
  const double r = std::hypot(x.x(), x.y());
  const Vec3 outward = r > 0 ? Vec3(x.x() / r, x.y() / r, 0) : Vec3::UnitX();
  if (a <= c) {
    const double z = a < c ? x.z() * c * c / (c * c - a * a) : 0;
    return a * std::sqrt(std::max(0.0, 1 - z * z / (c * c))) * outward + z * Vec3::UnitZ();
  }
  const double radius = r * a * a / (a * a - c * c);
  return radius * outward + c * std::sqrt(std::max(0.0, 1 - radius * radius / (a * a))) * Vec3::UnitZ();
}

double distance_to(const TruncatedEllipsoid& s, int label, const Vec3& x) {
  return (project_to_surface(s, label, x) - x).norm();
}

}  // namespace

TruncatedEllipsoid land_ellipsoid() {
  return {.endo_short_mm = 7, .endo_long_mm = 17, .epi_short_mm = 10, .epi_long_mm = 20, .base_z_mm = 5};
}

TruncatedEllipsoid human_lv() {
  return {.endo_short_mm = 20, .endo_long_mm = 64, .epi_short_mm = 30, .epi_long_mm = 73, .base_z_mm = 17};
}

void check_shape(const TruncatedEllipsoid& s) {
  const auto positive = [](const char* name, double value) {
    if (!(value > 0) || !std::isfinite(value))
      throw polyaffine::InputError(std::string(name) + ": found " + std::to_string(value) +
                                   " mm, expected a positive length");
  };
  positive("endo_short_mm", s.endo_short_mm);
  positive("endo_long_mm", s.endo_long_mm);
  positive("epi_short_mm", s.epi_short_mm);
  positive("epi_long_mm", s.epi_long_mm);
  const auto thicker = [](const char* name, double epi, double endo) {
    if (epi <= endo)
      throw polyaffine::InputError(std::string(name) + ": found " + std::to_string(epi) +
                                   " mm, expected more than the endocardial " + std::to_string(endo) + " mm");
  };
  thicker("epi_short_mm", s.epi_short_mm, s.endo_short_mm);
  thicker("epi_long_mm", s.epi_long_mm, s.endo_long_mm);
  if (!(std::abs(s.base_z_mm) < s.endo_long_mm))
    throw polyaffine::InputError("base_z_mm: found " + std::to_string(s.base_z_mm) +
                                 " mm, expected a plane between −" + std::to_string(s.endo_long_mm) +
                                 " and " + std::to_string(s.endo_long_mm) + " mm (endo_long_mm)");
}

TruncatedEllipsoid scaled(const TruncatedEllipsoid& s, double cavity, double wall) {
  const auto outside = [&](double endo, double epi) { return cavity * endo + wall * (epi - endo); };
  const TruncatedEllipsoid out{.endo_short_mm = cavity * s.endo_short_mm,
                               .endo_long_mm = cavity * s.endo_long_mm,
                               .epi_short_mm = outside(s.endo_short_mm, s.epi_short_mm),
                               .epi_long_mm = outside(s.endo_long_mm, s.epi_long_mm),
                               .base_z_mm = cavity * s.base_z_mm};
  check_shape(out);
  return out;
}

double default_mesh_size_mm(const TruncatedEllipsoid& s) {
  return 0.52 * (s.epi_short_mm - s.endo_short_mm);
}

double ellipsoid_function(const Vec3& semi_axes_mm, const Vec3& x) {
  const Vec3 scaled = x.cwiseQuotient(semi_axes_mm);
  const Vec3 normal = scaled.cwiseQuotient(semi_axes_mm);
  const double k0 = scaled.norm();
  const double k1 = normal.norm();
  return k1 > 0 ? k0 * (k0 - 1) / k1 : -semi_axes_mm.minCoeff();
}

double wall_function(const TruncatedEllipsoid& s, const Vec3& x) {
  return std::max({ellipsoid_function({s.epi_short_mm, s.epi_short_mm, s.epi_long_mm}, x),
                   -ellipsoid_function({s.endo_short_mm, s.endo_short_mm, s.endo_long_mm}, x),
                   x.z() - s.base_z_mm});
}

std::array<Points, 2> rims(const TruncatedEllipsoid& s, int n) {
  const auto circle = [&](double radius) {
    Points points(3, n + 1);
    for (int i = 0; i <= n; ++i) {
      const double angle = 2 * kPi * (i % n) / n;
      points.col(i) = Vec3(radius * std::cos(angle), radius * std::sin(angle), s.base_z_mm);
    }
    return points;
  };
  return {circle(rim_radius(s.endo_short_mm, s.endo_long_mm, s.base_z_mm)),
          circle(rim_radius(s.epi_short_mm, s.epi_long_mm, s.base_z_mm))};
}

double exact_cavity_volume(const TruncatedEllipsoid& s) {
  return cap_volume(s.endo_short_mm, s.endo_long_mm, s.base_z_mm);
}

double exact_wall_volume(const TruncatedEllipsoid& s) {
  return cap_volume(s.epi_short_mm, s.epi_long_mm, s.base_z_mm) - exact_cavity_volume(s);
}

// The nearest point is (a² r/(a² + t), c² z/(c² + t)) for the largest root t of
// (a r/(a² + t))² + (c z/(c² + t))² = 1 (Eberly 2013, Distance from a point to an ellipse). The left side
// falls monotonically for t > −min(a², c²), so bisection always finds the root.
Vec3 project_to_ellipsoid(double a, double c, const Vec3& x) {
  const double r = std::hypot(x.x(), x.y());
  const double excess_at = std::min(a, c) * std::min(a, c);
  const auto excess = [&](double t) {
    const double u = a * r / (a * a + t);
    const double v = c * x.z() / (c * c + t);
    return u * u + v * v - 1;
  };
  double low = -excess_at * (1 - 1e-12);
  double high = std::max(a, c) * (x.norm() + std::max(a, c));
  if (excess(low) <= 0) return from_focal_set(a, c, x);
  for (int i = 0; i < 200 && high - low > 1e-15 * (excess_at + std::abs(low)); ++i) {
    const double middle = (low + high) / 2;
    (excess(middle) > 0 ? low : high) = middle;
  }
  const double t = (low + high) / 2;
  return {x.x() * a * a / (a * a + t), x.y() * a * a / (a * a + t), x.z() * c * c / (c * c + t)};
}

Vec3 project_to_surface(const TruncatedEllipsoid& s, int label, const Vec3& x) {
  switch (label) {
    case kEndocardium:
      return project_to_ellipsoid(s.endo_short_mm, s.endo_long_mm, x);
    case kEpicardium:
      return project_to_ellipsoid(s.epi_short_mm, s.epi_long_mm, x);
    case kBase:
      return {x.x(), x.y(), s.base_z_mm};
    default:
      throw polyaffine::InputError("surface label: found " + std::to_string(label) + ", expected 1, 2 or 3");
  }
}

Vec3 project_to_rim(const TruncatedEllipsoid& s, int label, const Vec3& x) {
  const double radius = label == kEndocardium ? rim_radius(s.endo_short_mm, s.endo_long_mm, s.base_z_mm)
                                              : rim_radius(s.epi_short_mm, s.epi_long_mm, s.base_z_mm);
  const double r = std::hypot(x.x(), x.y());
  const Vec3 direction = r > 0 ? Vec3(x.x() / r, x.y() / r, 0) : Vec3::UnitX();
  return radius * direction + s.base_z_mm * Vec3::UnitZ();
}

Vec3 project_to_wall_surface(const TruncatedEllipsoid& s, double tolerance_mm, const Vec3& x) {
  const std::array<double, 3> distance{distance_to(s, kEndocardium, x), distance_to(s, kEpicardium, x),
                                       distance_to(s, kBase, x)};
  if (distance[kBase - 1] <= tolerance_mm)
    for (const int label : {kEndocardium, kEpicardium})
      if (distance[label - 1] <= tolerance_mm) return project_to_rim(s, label, x);
  const int nearest =
      1 + static_cast<int>(std::min_element(distance.begin(), distance.end()) - distance.begin());
  return project_to_surface(s, nearest, x);
}

int surface_label(const TruncatedEllipsoid& s, double tolerance_mm, const std::array<Vec3, 3>& triangle) {
  for (const int label : {kBase, kEndocardium, kEpicardium})
    if (std::all_of(triangle.begin(), triangle.end(),
                    [&](const Vec3& x) { return distance_to(s, label, x) <= tolerance_mm; }))
      return label;
  throw polyaffine::ComputationError(
      "a boundary triangle lies on no single surface of the ellipsoid; the mesh "
      "is too coarse for its wall, choose a smaller size");
}

}  // namespace cardiac
