#pragma once

#include <memory>

#include <cardiac/anatomy/coordinates.hpp>

namespace cardiac {

/// What lies where in the wall of two ventricles, and the coordinates of the right free wall.
///
/// From harmonic functions with no flux on what is not named: v is 0 on the left endocardium and 1 on the
/// right one, q is 0 on the left endocardium and 1 on the epicardium, t₀ is 0 on the left endocardium and 1
/// on both others.
/// - Transventricular w = q + v − t₀, harmonic: 0 in the left free wall (q = t₀, v = 0) and in the septum
///   (v = t₀, q = 0), 1 in the right free wall; it rises over about the thickness of the wall at the
///   insertions. Between 0 and 1 everywhere.
/// - Septum: where w < ½ and v > q, the way from the left endocardium through the wall ends on the right one.
/// - Depth t: 0 on the right endocardium, 1 on the epicardium, harmonic.
/// - Rotational ψ: the angle about the right ventricle's own axis, from the middle of the bottom of its
/// cavity
///   to that of its rim, −1 at the anterior and 1 at the inferior border of the free wall (averaged over its
///   height).
/// - Apicobasal: that of the left ventricle, which goes on into the right free wall.
class RightVentricularCoordinates {
 public:
  /// The fields alone; `settle` needs the axis of the left ventricle.
  RightVentricularCoordinates(const polyaffine::TetMesh& mesh, const SurfaceLabels& labels,
                              std::shared_ptr<const polyaffine::LagrangeBasis> space);
  void settle(const polyaffine::TetMesh& mesh, const SurfaceLabels& labels, const polyaffine::Vec3& axis,
              const polyaffine::Vec3& anterior);

  /// w and the share of the right ventricle σ, a cubic step of w from 0 at .1 to 1 at .9, with its gradient.
  struct Border {
    double w = 0, share = 0;
    polyaffine::Vec3 share_gradient = polyaffine::Vec3::Zero();
  };
  Border border(int tet, const polyaffine::Vec4& barycentric) const;
  /// v − q: positive in the septum, negative in the left free wall.
  double septal(int tet, const polyaffine::Vec4& barycentric) const;

  struct Sample {
    double t = 0, psi = 0;
    polyaffine::Vec3 grad_t, grad_psi;
  };
  Sample sample(int tet, const polyaffine::Vec4& barycentric) const;
  /// Height along the long axis, 0 at the bottom of the right cavity and 1 at the middle of its rim.
  double height(const polyaffine::Vec3& X) const;
  /// Distance from the right ventricle's axis, mm.
  double radius(const polyaffine::Vec3& X) const { return from_axis(X).norm(); }
  double half_angle() const { return half_angle_; }  ///< rad, of ψ = 1

  const polyaffine::Vec3& base_centre() const { return base_centre_; }  ///< of the rim of the right cavity
  const polyaffine::Vector& transventricular() const { return w_; }     ///< at the nodes of the space
  /// Harmonic, 0 on the left endocardium, 1 on the epicardium and the right endocardium; at the nodes.
  const polyaffine::Vector& left_depth() const { return left_depth_; }
  const polyaffine::Vector& transmural() const { return t_; }

 private:
  friend class polyaffine::ArchiveAccess;
  RightVentricularCoordinates() = default;
  template <class Archive>
  void archive(Archive& a) {
    a(space_, w_, septal_, left_depth_, t_, axis_, base_centre_, anterior_, outward_, long_axis_, length_,
      middle_, half_angle_);
    if constexpr (Archive::kReading)
      if (!is_whole()) a.refuse("found coordinates of the right ventricle whose parts do not fit each other");
  }
  bool is_whole() const;

  polyaffine::Vec3 from_axis(const polyaffine::Vec3& X) const;

  std::shared_ptr<const polyaffine::LagrangeBasis> space_;
  polyaffine::Vector w_, septal_, left_depth_, t_;
  polyaffine::Vec3 axis_, base_centre_, anterior_, outward_, long_axis_;
  double length_ = 0, middle_ = 0, half_angle_ = 1;
};

/// Middle and half width (rad) of an arc, from samples of its angle with weights, and the weight of the whole
/// circle: the half width is π times the share of the weight.
struct Arc {
  double middle = 0, half_width = 0;
};
Arc arc_of(const std::vector<double>& angle, const std::vector<double>& weight, double whole);

/// Direction from the middle of the bottom of a cavity (the lowest tenth of its height) to `rim`, for the
/// inner surface with this label; the middle is returned too.
struct CavityAxis {
  polyaffine::Vec3 direction, bottom;
};
CavityAxis cavity_axis(const polyaffine::TetMesh& mesh, int label, const polyaffine::Vec3& rim);

/// Middle, by length, of the closed edges of a surface; throws InputError when there is none or one leaves
/// the base.
polyaffine::Vec3 rim_centre(const polyaffine::TetMesh& mesh, int label, int base_label);

}  // namespace cardiac
