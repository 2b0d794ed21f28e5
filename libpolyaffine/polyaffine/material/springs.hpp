#pragma once

#include <vector>

#include <polyaffine/material/law.hpp>

namespace polyaffine {

/// Along the reference normal n of a point, u·n, or across it, u − (u·n) n.
enum class SpringDirection { along_normal, across_normal };

/// Elastic foundation on a surface, as a law over a displacement table (M = [u, 0, 0]): W = ½ k |u|², or
/// ½ k (u·n)² along the reference normals n of the points only, or ½ k |u − (u·n) n|² across them. k in
/// kPa/mm, W in kPa·mm.
class SurfaceSpring : public Law {
 public:
  /// All directions; throws InputError unless k > 0.
  explicit SurfaceSpring(double stiffness);
  /// Along unit normals, one a point, or across them.
  SurfaceSpring(double stiffness, Points normals, SpringDirection direction = SpringDirection::along_normal);
  void respond(PackPoints points, const PackMotion& at, bool tangent, PackResponse& r) const override;

 private:
  double stiffness_;
  Points normals_;
  SpringDirection direction_ = SpringDirection::along_normal;
};

/// Springs on the mean motion of a body, as a law over a mean_motion_table (M = [ū, θ n, 0]): W = ½ k (|ū −
/// (ū·n) n|² + ℓ² θ²), which resists what a body does in the plane across n. k in mN/mm, W in µJ.
class MeanMotionSpring : public Law {
 public:
  /// `arm` ℓ in mm. Throws InputError unless k > 0.
  MeanMotionSpring(double stiffness, const Vec3& normal, double arm = 10);
  void respond(PackPoints points, const PackMotion& at, bool tangent, PackResponse& r) const override;

 private:
  double stiffness_, arm_;
  Vec3 normal_;
};

/// Dead traction T (kPa, per reference area): W = −T·u over a displacement table.
class DeadTraction : public Law {
 public:
  explicit DeadTraction(const Vec3& traction) : traction_(traction) {}
  void respond(PackPoints points, const PackMotion& at, bool tangent, PackResponse& r) const override;

 private:
  Vec3 traction_;
};

}  // namespace polyaffine
