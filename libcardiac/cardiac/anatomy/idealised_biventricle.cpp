#include "cardiac/anatomy/idealised_biventricle.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <polyaffine/core/error.hpp>

namespace cardiac {
namespace {

constexpr std::array<int, 3> kSurfaces{kEndocardium, kEpicardium, kRvEndocardium};

// Smaller of two numbers, rounded where they differ by less than k.
double smooth_min(double a, double b, double k) {
  const double h = std::max(k - std::abs(a - b), 0.0) / k;
  return std::min(a, b) - h * h * k / 4;
}

double lv_function(const IdealisedBiventricle& s, int label, const Vec3& x) {
  const auto& lv = s.lv;
  return label == kEndocardium ? ellipsoid_function({lv.endo_short_mm, lv.endo_short_mm, lv.endo_long_mm}, x)
                               : ellipsoid_function({lv.epi_short_mm, lv.epi_short_mm, lv.epi_long_mm}, x);
}

double rv_function(const IdealisedBiventricle& s, double offset_mm, const Vec3& x) {
  return ellipsoid_function(s.rv_endo_mm + Vec3::Constant(offset_mm), x - s.rv_centre_mm * Vec3::UnitX());
}

Vec3 gradient(const IdealisedBiventricle& s, int label, const Vec3& x) {
  constexpr double kStep = 1e-4;  // mm
  Vec3 out;
  for (int k = 0; k < 3; ++k)
    out[k] = (surface_function(s, label, x + kStep * Vec3::Unit(k)) -
              surface_function(s, label, x - kStep * Vec3::Unit(k))) /
             (2 * kStep);
  return out;
}

// Newton's method along the gradient, within the base plane where asked for.
Vec3 project(const IdealisedBiventricle& s, int label, bool in_base_plane, Vec3 x) {
  if (in_base_plane) x.z() = s.lv.base_z_mm;
  for (int i = 0; i < 50; ++i) {
    Vec3 g = gradient(s, label, x);
    if (in_base_plane) g.z() = 0;
    const Vec3 step = surface_function(s, label, x) * g / g.squaredNorm();
    x -= step;
    if (step.norm() < 1e-10 * s.lv.epi_long_mm) break;
  }
  return x;
}

// Follows the line in the base plane from a point on it until it closes.
Points trace_rim(const IdealisedBiventricle& s, int label, const Vec3& near, double step_mm) {
  std::vector<Vec3> line{project(s, label, true, near)};
  do {
    const Vec3 g = gradient(s, label, line.back());
    line.push_back(project(s, label, true, line.back() + step_mm * Vec3(-g.y(), g.x(), 0).normalized()));
  } while (line.size() < 3 || (line.back() - line.front()).norm() > step_mm);
  line.back() = line.front();
  Points out(3, static_cast<Eigen::Index>(line.size()));
  for (Eigen::Index i = 0; i < out.cols(); ++i) out.col(i) = line[i];
  return out;
}

}  // namespace

IdealisedBiventricle human_biventricle() {
  return {.lv = human_lv(), .rv_centre_mm = 25, .rv_endo_mm = {30, 31, 56}, .rv_wall_mm = 5, .blend_mm = 5};
}

double default_mesh_size_mm(const IdealisedBiventricle& s) {
  return 1.1 * s.rv_wall_mm;
}

double surface_function(const IdealisedBiventricle& s, int label, const Vec3& x) {
  switch (label) {
    case kEndocardium:
      return lv_function(s, kEndocardium, x);
    case kEpicardium:
      return smooth_min(lv_function(s, kEpicardium, x), rv_function(s, s.rv_wall_mm, x), s.blend_mm);
    case kRvEndocardium:
      return -smooth_min(-rv_function(s, 0, x), lv_function(s, kEpicardium, x), s.blend_mm);
    default:
      throw polyaffine::InputError("surface label: found " + std::to_string(label) + ", expected 1, 2 or 4");
  }
}

double wall_function(const IdealisedBiventricle& s, const Vec3& x) {
  return std::max({surface_function(s, kEpicardium, x), -surface_function(s, kEndocardium, x),
                   -surface_function(s, kRvEndocardium, x), x.z() - s.lv.base_z_mm});
}

std::array<Points, 3> rims(const IdealisedBiventricle& s, double step_mm) {
  const double z = s.lv.base_z_mm;
  return {trace_rim(s, kEndocardium, {-s.lv.endo_short_mm, 0, z}, step_mm),
          trace_rim(s, kEpicardium, {-s.lv.epi_short_mm, 0, z}, step_mm),
          trace_rim(s, kRvEndocardium, {s.rv_centre_mm + s.rv_endo_mm.x(), 0, z}, step_mm)};
}

Vec3 project_to_wall_surface(const IdealisedBiventricle& s, double tolerance_mm, const Vec3& x) {
  const auto away = [&](int label) { return std::abs(surface_function(s, label, x)); };
  const int label =
      *std::min_element(kSurfaces.begin(), kSurfaces.end(), [&](int a, int b) { return away(a) < away(b); });
  const double from_base = std::abs(x.z() - s.lv.base_z_mm);
  if (from_base > tolerance_mm && away(label) < from_base) return project(s, label, false, x);
  if (away(label) <= tolerance_mm) return project(s, label, true, x);
  return {x.x(), x.y(), s.lv.base_z_mm};
}

int surface_label(const IdealisedBiventricle& s, double tolerance_mm, const std::array<Vec3, 3>& triangle) {
  if (std::all_of(triangle.begin(), triangle.end(),
                  [&](const Vec3& x) { return std::abs(x.z() - s.lv.base_z_mm) <= tolerance_mm; }))
    return kBase;
  const auto away = [&](int label) {
    double largest = 0;
    for (const Vec3& x : triangle) largest = std::max(largest, std::abs(surface_function(s, label, x)));
    return largest;
  };
  return *std::min_element(kSurfaces.begin(), kSurfaces.end(),
                           [&](int a, int b) { return away(a) < away(b); });
}

int wall_region(const IdealisedBiventricle& s, const Vec3& x) {
  if (lv_function(s, kEpicardium, x) > 0) return kRvWall;
  const Vec3 outside = project_to_ellipsoid(s.lv.epi_short_mm, s.lv.epi_long_mm, x);
  return rv_function(s, 0, outside) < 0 ? kSeptum : kLvWall;
}

}  // namespace cardiac
