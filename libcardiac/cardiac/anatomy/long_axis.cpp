#include "cardiac/anatomy/long_axis.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <sstream>

#include <cardiac/anatomy/coordinates.hpp>
#include <cardiac/anatomy/right_ventricle.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/mesh/surface.hpp>

namespace cardiac {
namespace {

using polyaffine::InputError;
using polyaffine::TetMesh;
using polyaffine::Vec3;

// Length of the mean normal of a base from which it counts as flat.
constexpr double kFlat = 0.999;
// Angle below which apex to base centre and the normal of a flat base are the same: the middle of a blunt
// apex moves by some 3 mm in 60 with the mesh.
constexpr double kSameDeg = 3;
// Angle to the normal of the opening above which there is a warning, and of a given axis to that of the
// cavity above which it is none.
constexpr double kObliqueDeg = 10, kAcrossDeg = 60;

std::string text(const Vec3& v) {
  std::ostringstream out;
  out.precision(4);
  out << '(' << v.x() << ", " << v.y() << ", " << v.z() << ')';
  return out.str();
}

std::string degrees(double angle) {
  std::ostringstream out;
  out.precision(1);
  out << std::fixed << angle << "°";
  return out.str();
}

double angle_deg(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / polyaffine::kPi;
}

struct Rim {
  Vec3 centre, area;  ///< area vector, mm², out of the cavity
};

Rim describe(const TetMesh& mesh, const std::vector<int>& loop) {
  Rim out{Vec3::Zero(), Vec3::Zero()};
  double length = 0;
  const Vec3 origin = mesh.points().col(loop.front());
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vec3 a = mesh.points().col(loop[k]), b = mesh.points().col(loop[(k + 1) % loop.size()]);
    out.centre += (b - a).norm() * (a + b) / 2;
    out.area += (a - origin).cross(b - origin) / 2;
    length += (b - a).norm();
  }
  out.centre /= length;
  return out;
}

/// The rims of the endocardium, which must run along the base.
std::vector<Rim> openings(const TetMesh& mesh, const SurfaceLabels& labels) {
  const auto loops = polyaffine::rim_loops(mesh.surface({labels.endo}));
  if (loops.empty())
    throw InputError("closed cavity: the endocardium has no rim, expected an opening at the base");
  const std::vector<int> base = mesh.surface_points({labels.base});
  std::vector<Rim> out;
  for (const auto& loop : loops) {
    for (const int p : loop)
      if (!std::ranges::binary_search(base, p))
        throw InputError("open cavity: found the rim of the endocardium off the base at " +
                         text(mesh.points().col(p)) +
                         " mm, expected the endocardium to reach the base all round");
    out.push_back(describe(mesh, loop));
  }
  return out;
}

/// Length of the mean normal of a surface: 1 where it is flat.
double flatness(const TetMesh& mesh, int label) {
  Vec3 sum = Vec3::Zero();
  double area = 0;
  const polyaffine::Triangles faces = mesh.surface({label});
  for (const auto& f : faces.colwise()) {
    const Vec3 a = mesh.points().col(f[0]);
    const Vec3 normal = (mesh.points().col(f[1]) - a).cross(mesh.points().col(f[2]) - a);
    sum += normal;
    area += normal.norm();
  }
  return sum.norm() / area;
}

}  // namespace

LongAxis find_long_axis(const TetMesh& mesh, const SurfaceLabels& labels, const std::optional<Vec3>& given,
                        const std::optional<Vec3>& mitral_point) {
  const std::vector<Rim> rims = openings(mesh, labels);
  const auto mitral = std::ranges::min_element(rims, {}, [&](const Rim& rim) {
    return mitral_point ? (rim.centre - *mitral_point).norm() : -rim.area.norm();
  });
  LongAxis out;
  out.openings = static_cast<int>(rims.size());
  out.mitral_known = rims.size() == 1 || mitral_point.has_value();
  out.base_centre = mitral->centre;
  const Vec3 from_apex = cavity_axis(mesh, labels.endo, out.base_centre).direction;
  out.base_normal = mitral->area.normalized();
  if (out.base_normal.dot(from_apex) < 0) out.base_normal = -out.base_normal;
  out.base_angle_deg = angle_deg(from_apex, out.base_normal);
  out.direction = from_apex;
  out.normal_taken =
      !given && rims.size() == 1 && out.base_angle_deg < kSameDeg && flatness(mesh, labels.base) > kFlat;
  if (out.normal_taken) out.direction = out.base_normal;
  if (!given) return out;
  out.given = true;
  out.direction = given->normalized();
  if (const double off = angle_deg(out.direction, from_apex); off > kAcrossDeg)
    throw InputError("long axis (anatomy.long_axis, --long-axis): found " + text(*given) + ", " +
                     degrees(off) + " off the way from the apex of the cavity to the base, " +
                     text(from_apex) + ", expected a direction from apex to base");
  return out;
}

std::vector<std::string> notes_of(const LongAxis& axis) {
  std::string way = axis.given ? "as given"
                    : axis.normal_taken
                        ? "normal of the flat base, as apex to base centre within " + degrees(kSameDeg)
                        : "apex to base centre";
  std::vector<std::string> out{"long axis " + text(axis.direction) + ": " + way +
                               "; from apex to base centre it is " + degrees(axis.base_angle_deg) +
                               " to the normal of the opening"};
  if (axis.openings > 1)
    out.push_back(std::to_string(axis.openings) +
                  " openings of the left cavity: the axis runs to the centre " + text(axis.base_centre) +
                  " mm of " +
                  (axis.mitral_known ? "the one nearest to the mitral point"
                                     : "the largest, taken as the mitral one (if it is not: "
                                       "anatomy.mitral_point, --mitral-point)"));
  return out;
}

std::vector<std::string> warnings_of(const LongAxis& axis) {
  if (axis.given || axis.openings > 1 || axis.base_angle_deg <= kObliqueDeg) return {};
  return {"the long axis, from apex to base centre, is " + degrees(axis.base_angle_deg) +
          " off the normal of the base (more than 10°): is the base cut obliquely? anatomy.long_axis "
          "(--long-axis) sets another axis"};
}

}  // namespace cardiac
