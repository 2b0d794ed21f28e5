#pragma once

#include <array>
#include <memory>
#include <optional>

#include <polyaffine/geometry/polynomial_field.hpp>
#include <polyaffine/kinematics/lagrange.hpp>
#include <polyaffine/mesh/tet_mesh.hpp>

namespace cardiac {

/// Labels of the boundary of a left ventricle.
struct SurfaceLabels {
  int endo = 1, epi = 2, base = 3;
};

struct AnatomyOptions {
  std::optional<polyaffine::Vec3> long_axis;  ///< apex to base; absent: the mean outward normal of the base
  polyaffine::Vec3 anterior = {0, 1, 0};      ///< from the axis to the anterior wall
  std::optional<polyaffine::EdgeMidpoints> midpoints{};  ///< of boundary edges; absent: smooth_midpoints
};

/// Ventricular coordinates and local axes at one point of the wall.
struct CoordinateSample {
  double u = 0;    ///< apicobasal, 0 on the axis through the apex to 1 at the base, by arc length
  double t = 0;    ///< transmural depth, 0 endocardium to 1 epicardium
  double psi = 0;  ///< rotational, (−π, π], 0 anterior, growing towards the septum
  polyaffine::Vec3 grad_u, grad_t, grad_psi;
  polyaffine::Mat3 Q;                  ///< columns longitudinal, circumferential, radial; orthonormal
  std::array<polyaffine::Mat3, 3> dQ;  ///< ∂Q/∂X_J
};

/// Coordinates of a left ventricle, with quadratic elements on the curved wall.
///
/// - Transmural t: ∇·(w ∇t) = 0, 0 on the endocardium and 1 on the epicardium, w = |∇t'| of the harmonic t'
///   (w = 1): where the wall spreads the harmonic depth runs ahead, with the weight |∇t| is even along the
///   way through the wall.
/// - Radial axis e_r: the direction of a polynomial of degree 5 in X closest to ∇t. ∂Q multiplies the
///   displacement itself, so axes must be smooth above all; the gradient of a mesh's ∇t is not.
/// - Rotational ψ: the angle about the long axis, counter-clockwise seen from the apex.
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
  /// Throws InputError when a label is missing, the endocardium has not exactly one rim or that leaves the
  /// base, or the anterior direction is parallel to the long axis.
  VentricularCoordinates(const polyaffine::TetMesh& mesh, const SurfaceLabels& labels,
                         const AnatomyOptions& options);

  CoordinateSample sample(int tet, const polyaffine::Vec4& barycentric) const;
  polyaffine::Vec3 position(int tet, const polyaffine::Vec4& barycentric) const;  ///< mm
  /// Height along the long axis, 0 at the apex of the cavity and 1 at the base.
  double long_axis_height(const polyaffine::Vec3& X) const;
  /// Rotational coordinate of a position.
  double angle(const polyaffine::Vec3& X) const;

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
  void find_axis(const polyaffine::TetMesh& mesh, const SurfaceLabels& labels, const AnatomyOptions& options);
  void solve_transmural(const polyaffine::TetMesh& mesh, const SurfaceLabels& labels);
  void solve_apicobasal(const polyaffine::TetMesh& mesh, const SurfaceLabels& labels);
  polyaffine::Vec3 from_axis(const polyaffine::Vec3& X) const;  ///< perpendicular from the long axis, mm

  std::shared_ptr<const polyaffine::LagrangeBasis> space_;
  polyaffine::Vec3 axis_, base_centre_, anterior_, septal_;
  double cavity_length_ = 0, arc_length_ = 0;
  std::optional<polyaffine::PolynomialField> radial_;  // not of unit length
  polyaffine::Vector t_, slope_, rest_;                // t, g and h by node
};

}  // namespace cardiac
