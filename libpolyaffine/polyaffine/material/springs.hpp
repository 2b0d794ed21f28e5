#pragma once

#include <vector>

#include <polyaffine/material/law.hpp>

namespace polyaffine {

/// Elastic foundation on a surface, as a law over a displacement table (M = [u, 0, 0]): W = ½ k |u|², or
/// ½ k (u·n)² along the reference normals n of the points only. k in kPa/mm, W in kPa·mm.
class SurfaceSpring : public Law {
 public:
  /// All directions; throws InputError unless k > 0.
  explicit SurfaceSpring(double stiffness);
  /// Along unit normals, one a point.
  SurfaceSpring(double stiffness, Points normals);
  void respond(PackPoints points, const PackMotion& at, bool tangent, PackResponse& r) const override;

 private:
  double stiffness_;
  Points normals_;
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
