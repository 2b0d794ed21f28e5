#pragma once

#include <array>
#include <memory>
#include <optional>

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
  polyaffine::Mat3 Q;                  ///< columns longitudinal, circumferential, radial; nearly orthonormal
  std::array<polyaffine::Mat3, 3> dQ;  ///< ∂Q/∂X_J
};

/// Coordinates of a left ventricle. Apicobasal and transmural come from Laplace problems with quadratic
/// elements: transmural 0 on the endocardium, 1 on the epicardium; apicobasal 0 on the axis through the
/// apical wall, 1 on the base, then made proportional to arc length, ds/du = ∫dV / ∫|∇u|dV over each level.
/// Rotational is the angle about the long axis, counter-clockwise seen from the apex. Axes: radial e_r ∥ ∇t,
/// circumferential e_c = axis × e_r, longitudinal e_l = e_r × e_c (towards the base), continuous over the
/// mesh.
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
  const polyaffine::Vector& apicobasal() const { return u_; }  ///< at the vertices, then the edge midpoints
  const polyaffine::Vector& transmural() const { return t_; }
  /// Axes at the vertices, then the edge midpoints: nine numbers a column, [e_l e_c e_r].
  const polyaffine::Matrix& axes() const { return axes_; }

 private:
  void find_axis(const polyaffine::TetMesh& mesh, const SurfaceLabels& labels, const AnatomyOptions& options);
  void solve_transmural(const polyaffine::TetMesh& mesh, const SurfaceLabels& labels);
  void solve_apicobasal(const polyaffine::TetMesh& mesh, const SurfaceLabels& labels);
  void build_axes();

  std::shared_ptr<const polyaffine::LagrangeBasis> space_;
  polyaffine::Vec3 axis_, base_centre_, anterior_, septal_;
  double cavity_length_ = 0, arc_length_ = 0;
  polyaffine::Vector u_, t_;
  polyaffine::Matrix axes_;  // 9 × nodes
};

}  // namespace cardiac
