#pragma once

#include <array>
#include <memory>
#include <optional>

#include <cardiac/anatomy/long_axis.hpp>
#include <polyaffine/core/monotone_cubic.hpp>
#include <polyaffine/fields/polynomial_field.hpp>
#include <polyaffine/kinematics/lagrange.hpp>
#include <polyaffine/mesh/tet_mesh.hpp>

namespace cardiac {

class RightVentricularCoordinates;

/// Labels of the boundary of a left ventricle, or of both.
struct SurfaceLabels {
  int endo = 1, epi = 2, base = 3;
  std::optional<int> rv_endo{};  ///< absent: no right ventricle
};

template <class Archive>
void archive(Archive& a, SurfaceLabels& x) {
  a(x.endo, x.epi, x.base, x.rv_endo);
}

struct AnatomyOptions {
  std::optional<polyaffine::Vec3> long_axis{};     ///< apex to base; absent: find_long_axis
  std::optional<polyaffine::Vec3> mitral_point{};  ///< mm, near the mitral of several openings
  /// What tells where anterior is without a right ventricle, the first that is there: a point of the middle
  /// of the septum (ψ = 90°) or of the anterior insertion of the right ventricle (ψ = 30°, the border of
  /// segments 1 and 2), mm; the direction from the axis to the anterior wall. All absent: +y is assumed.
  std::optional<polyaffine::Vec3> septum_point{}, rv_insertion_point{}, anterior{};
  std::optional<polyaffine::EdgeMidpoints> midpoints{};  ///< of boundary edges; absent: smooth_midpoints
};

/// Ventricular coordinates and local axes at one point of the wall.
struct CoordinateSample {
  double u = 0;    ///< apicobasal, 0 on the axis through the apex to 1 at the base, by arc length
  double t = 0;    ///< transmural depth, 0 endocardium to 1 epicardium
  double psi = 0;  ///< rotational, (−π, π], 0 anterior, growing towards the septum
  double w = 0;    ///< transventricular, 0 in the left wall and the septum, 1 in the right free wall
  polyaffine::Vec3 grad_u, grad_t, grad_psi;
  polyaffine::Mat3 Q;                  ///< columns longitudinal, circumferential, radial; orthonormal
  std::array<polyaffine::Mat3, 3> dQ;  ///< ∂Q/∂X_J
};

/// The coordinates alone.
struct CoordinatePlace {
  double u = 0, t = 0, psi = 0;  ///< as in CoordinateSample
};

/// Coordinates of a left ventricle, with quadratic elements on the curved wall. With a right ventricle they
/// are those of the left wall and the septum and go on into the right free wall, which has its own (right()).
///
/// - Transmural t: ∇·(w ∇t) = 0, 0 on the endocardium and 1 on the epicardium, w = |∇t'| of the harmonic t'
///   (w = 1): where the wall spreads the harmonic depth runs ahead, with the weight |∇t| is even along the
///   way through the wall.
/// - Radial axis e_r: the direction of a polynomial of degree 5 in X closest to ∇t. ∂Q multiplies the
///   displacement itself, so axes must be smooth above all; the gradient of a mesh's ∇t is not.
/// - Rotational ψ: the angle about the long axis, counter-clockwise seen from the apex. With a right
/// ventricle
///   the angle is stretched smoothly so that the anterior insertion has ψ = 30°, the inferior one 150° and
///   the septum and the rest are divided evenly: equal ψ means the same place in every heart.
/// - Apicobasal u: ∇·(|∇ψ| |∇t| ∇u) = 0, 0 on the long axis through the apical wall, 1 on the base. A strip
/// of
///   the wall between two angles conducts by its width 1/|∇ψ| and its thickness 1/|∇t|, which the weights
///   cancel: u is the share of the arc length from apex to base, its levels cross the wall along the normal.
///   About the axis u has a cone, so u = r g / (r g + h) with the distance r from the axis and two fields g
///   and h, h = 0 on the base.
/// - Circumferential axis e_c: the direction of rotation across e_r; longitudinal e_l = e_r × e_c (towards
/// the
///   base). Q = [e_l e_c e_r] is orthonormal at every point.
class VentricularCoordinates {
 public:
  /// Throws InputError when a label is missing, an endocardium has no rim or one that leaves the base, the
  /// anterior direction is parallel to the long axis, or there is no septum between the endocardia.
  VentricularCoordinates(const polyaffine::TetMesh& mesh, const SurfaceLabels& labels,
                         const AnatomyOptions& options);

  CoordinateSample sample(int tet, const polyaffine::Vec4& barycentric) const;
  /// u, t and ψ of `sample`, the same to the last bit, without gradients and axes, which take most of its
  /// time.
  CoordinatePlace place(int tet, const polyaffine::Vec4& barycentric) const;
  /// The same with the depth and axes (Q; its derivatives are zero) of the right free wall; only with a right
  /// ventricle.
  CoordinateSample right_sample(int tet, const polyaffine::Vec4& barycentric) const;
  /// That of the ventricle to which the point belongs (right where w > ½): what strain is told in.
  CoordinateSample wall_sample(int tet, const polyaffine::Vec4& barycentric) const;
  polyaffine::Vec3 position(int tet, const polyaffine::Vec4& barycentric) const;  ///< mm
  /// Height along the long axis, 0 at the apex of the cavity and 1 at the base.
  double long_axis_height(const polyaffine::Vec3& X) const;
  /// Rotational coordinate of a position.
  double angle(const polyaffine::Vec3& X) const;
  /// Angle about the long axis without stretching, (−π, π], 0 anterior.
  double plain_angle(const polyaffine::Vec3& X) const;
  /// The angle by which AHA segments are divided: ψ, in the apical third the plain one, in which its four
  /// sectors are right angles about the middle of the septum.
  double sector_angle(const polyaffine::Vec3& X) const;
  /// Null without a right ventricle.
  const RightVentricularCoordinates* right() const { return right_.get(); }

  const LongAxis& long_axis() const { return long_axis_; }
  /// Nothing said where anterior is: it was taken as +y.
  bool anterior_assumed() const { return anterior_assumed_; }
  const polyaffine::Vec3& axis() const { return axis_; }
  const polyaffine::Vec3& anterior() const { return anterior_; }  ///< unit, across the axis
  const polyaffine::Vec3& base_centre() const { return base_centre_; }
  double cavity_length() const { return cavity_length_; }  ///< mm, apex of the cavity to the base
  double arc_length() const { return arc_length_; }        ///< mm, along the wall, apex to base
  /// The curved quadratic elements of the wall on which the coordinates live.
  const polyaffine::LagrangeBasis& space() const { return *space_; }
  /// At the vertices, then the edge midpoints.
  polyaffine::Vector apicobasal() const;
  const polyaffine::Vector& transmural() const { return t_; }
  /// Axes at the vertices, then the edge midpoints: nine numbers a column, [e_l e_c e_r].
  polyaffine::Matrix axes() const;

 private:
  friend class polyaffine::ArchiveAccess;
  VentricularCoordinates() = default;
  template <class Archive>
  void archive(Archive& a) {
    a(space_, long_axis_, axis_, base_centre_, anterior_, septal_, anterior_assumed_, cavity_length_,
      arc_length_, least_steepness_, stretch_, right_, radial_, t_, slope_, rest_);
    if constexpr (Archive::kReading)
      if (!is_whole()) a.refuse("found ventricular coordinates whose parts do not fit each other");
  }
  bool is_whole() const;

  void orient_by(const AnatomyOptions& options);
  void orient(const polyaffine::Vec3& anterior);
  void find_insertions(const polyaffine::TetMesh& mesh);
  void solve_transmural(const polyaffine::TetMesh& mesh, const SurfaceLabels& labels);
  void fit_radial(const polyaffine::WallPoints& points, const polyaffine::Vector& weights);
  void solve_apicobasal(const polyaffine::TetMesh& mesh, const SurfaceLabels& labels);
  void measure_arc_length(const polyaffine::TetMesh& mesh);
  void set_axes(const polyaffine::Vec3& X, const polyaffine::Vec3& away, double r,
                CoordinateSample& out) const;
  polyaffine::Vec3 from_axis(const polyaffine::Vec3& X) const;  ///< perpendicular from the long axis, mm

  std::shared_ptr<const polyaffine::LagrangeBasis> space_;
  LongAxis long_axis_;
  polyaffine::Vec3 axis_, base_centre_, anterior_, septal_;
  bool anterior_assumed_ = false;
  double cavity_length_ = 0, arc_length_ = 0;
  double least_steepness_ = 0;  // of the depth in the coefficients, 1/mm; 0 without a right ventricle
  std::optional<polyaffine::MonotoneCubic> stretch_;  // of the plain angle, three turns of it
  std::shared_ptr<RightVentricularCoordinates> right_;
  std::optional<polyaffine::PolynomialField> radial_;  // not of unit length
  polyaffine::Vector t_, slope_, rest_;                // t, g and h by node
};

}  // namespace cardiac
