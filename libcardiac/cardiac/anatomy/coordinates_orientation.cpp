#include <Eigen/Geometry>
#include <cmath>
#include <sstream>

#include <cardiac/anatomy/coordinates.hpp>
#include <cardiac/anatomy/right_ventricle.hpp>
#include <polyaffine/core/error.hpp>

// Where the rotational coordinate ψ of VentricularCoordinates begins, and how it is stretched.

namespace cardiac {

using polyaffine::InputError;
using polyaffine::kPi;
using polyaffine::Vec3;
using polyaffine::Vec4;

namespace {

// A point nearer to the long axis than this share of the cavity's length says nothing about directions across
// the axis: a millimetre of error turns its direction by more than ten degrees.
constexpr double kOnAxis = 0.05;
// A direction closer to the long axis than this sine, about 3°, says nothing about directions across it.
constexpr double kAlongAxis = 0.05;
// Rotational coordinate of the anterior insertion of the right ventricle: the border of segments 1 and 2.
constexpr double kInsertion = kPi / 6;
// The septum is a part of the left ventricle; beyond this share of it the endocardia are taken for mistaken.
constexpr double kWidestSeptum = 0.9;
// The septum is measured above the apical third of the long axis, where it narrows to nothing.
constexpr double kSeptumFrom = 1.0 / 3;

std::string text(const Vec3& v) {
  std::ostringstream out;
  out << '(' << v.x() << ", " << v.y() << ", " << v.z() << ')';
  return out.str();
}

// ψ from the plain angle about the long axis. The insertions of the right ventricle come to 30° and 150°, and
// both the septum and the rest are divided evenly:
//
//     angle from the middle of the septum   −half   0     half   half + q   π      half + 3 q
//     ψ                                      30°    90°   150°   210°       270°   330°
//                                            ├── septum ──┤──────── free wall ──────── …
//
// half is the half width of the septum, q a quarter of the rest, so that half + 4 q = 2π − half begins the
// next turn. Four turns make the interpolation periodic where it is used, from −π to π.
polyaffine::MonotoneCubic stretch_of_angle(double half) {
  const double quarter = (kPi - half) / 2;
  std::vector<double> from, to;
  for (int turn = -2; turn <= 1; ++turn)
    for (int k = 0; k < 6; ++k) {
      const double from_septum = k < 3 ? (k - 1) * half : half + (k - 2) * quarter;
      from.push_back(kPi / 2 + from_septum + turn * 2 * kPi);
      to.push_back(kPi / 6 + k * kPi / 3 + turn * 2 * kPi);
    }
  return {from, to};
}

}  // namespace

void VentricularCoordinates::orient_by(const AnatomyOptions& options) {
  const auto across = [&](const Vec3& point, const char* name) {
    const Vec3 d = from_axis(point);
    if (!(d.norm() > kOnAxis * cavity_length_))
      throw InputError(std::string(name) + ": found " + text(point) + " mm, on the long axis " + text(axis_) +
                       ", expected a point in the wall");
    return Vec3(d.normalized());
  };
  if (options.septum_point) {
    orient(axis_.cross(across(*options.septum_point, "septum point (anatomy.septum_point, --septum-point)")));
  } else if (options.rv_insertion_point) {
    const Vec3 d = across(*options.rv_insertion_point,
                          "insertion point (anatomy.rv_insertion_point, --rv-insertion-point)");
    orient(std::cos(kInsertion) * d + std::sin(kInsertion) * axis_.cross(d));
  } else {
    orient(options.anterior.value_or(Vec3::UnitY()));
    anterior_assumed_ = !options.anterior;
  }
}

void VentricularCoordinates::orient(const Vec3& anterior) {
  const Vec3 across = anterior - anterior.dot(axis_) * axis_;
  if (!(across.norm() > kAlongAxis * anterior.norm()))
    throw InputError("anterior direction (anatomy.anterior_direction, --anterior): found " + text(anterior) +
                     ", parallel to the long axis " + text(axis_) + ", expected a direction across it");
  anterior_ = across.normalized();
  septal_ = -axis_.cross(anterior_);
}

// Turns the axes so that ψ = 90° is the middle of the septum, and stretches the angle by its width. With the
// plain angle ψ, the height h along the axis a and the depth t, dV |∇ψ · (a × ∇t)| = dψ dh dt: summed over
// the septum and over the whole left ventricle this compares the angles they take up, as means over the
// height.
void VentricularCoordinates::find_insertions(const polyaffine::TetMesh& mesh) {
  orient(axis_.unitOrthogonal());
  std::vector<double> angle, weight;
  double whole = 0;
  for (int t = 0; t < mesh.num_tets(); ++t) {
    const Vec4 centre = Vec4::Constant(0.25);
    const Vec3 X = mesh.tet_centroid(t);
    const double h = long_axis_height(X);
    if (h < kSeptumFrom || h > 1 || right_->border(t, centre).w > 0.5) continue;
    const auto s = space_->element_sample(t, centre);
    const Vec3 d = from_axis(X);
    const double share =
        mesh.tet_volume(t) * std::abs(axis_.cross(d).dot(axis_.cross(s.slope(t_)))) / d.squaredNorm();
    whole += share;
    if (right_->septal(t, centre) <= 0) continue;
    angle.push_back(plain_angle(X));
    weight.push_back(share);
  }
  const Arc septum = arc_of(angle, weight, whole);
  const double half = septum.half_width;
  if (!(half > 0 && half < kWidestSeptum * kPi))
    throw InputError("septum: found " + std::to_string(2 * half * 180 / kPi) +
                     " degrees of the left ventricle between the two endocardia, expected more than 0 and "
                     "less than 324");
  orient(axis_.cross(std::cos(septum.middle) * anterior_ + std::sin(septum.middle) * septal_));
  stretch_.emplace(stretch_of_angle(half));
}

}  // namespace cardiac
