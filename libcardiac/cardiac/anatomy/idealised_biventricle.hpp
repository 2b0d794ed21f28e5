#pragma once

#include <array>

#include <cardiac/anatomy/idealised.hpp>

namespace cardiac {

/// A left ventricle between two ellipsoids with a right ventricle leaning on it: an ellipsoid with the centre
/// (rv_centre_mm, 0, 0) whose cavity ends at the left ventricle's outer surface, the septum. Apex towards −z,
/// anterior +y. Where left and right meet, outside and in the corners of the right cavity, the surfaces pass
/// into each other smoothly over blend_mm. All cut by the plane z = lv.base_z_mm; lengths in mm.
struct IdealisedBiventricle {
  TruncatedEllipsoid lv;
  double rv_centre_mm = 0;
  Vec3 rv_endo_mm = Vec3::Ones();  ///< semi-axes of the right cavity along x, y, z
  double rv_wall_mm = 0;
  double blend_mm = 0;
};

/// Unloaded human size: cavities of about 75 mL (left) and 80 mL (right), walls 10 and 5 mm.
IdealisedBiventricle human_biventricle();

/// An edge length that leaves about one tet through the right wall, mm.
double default_mesh_size_mm(const IdealisedBiventricle& shape);

/// Negative in the wall, zero on its surface, positive outside; in mm near the surface.
double wall_function(const IdealisedBiventricle& shape, const Vec3& x);

/// Negative inside a closed surface (kEndocardium and kRvEndocardium: in the cavity, kEpicardium: in wall and
/// cavities) before the base cuts it; in mm near the surface. Throws InputError for another label.
double surface_function(const IdealisedBiventricle& shape, int label, const Vec3& x);

/// Edges of the base: closed lines (first point repeated) on which the surfaces meet the base plane, with
/// points `step_mm` apart: left endocardium, epicardium, right endocardium.
std::array<Points, 3> rims(const IdealisedBiventricle& shape, double step_mm);

/// The point of the wall's surface that x, near to it, belongs to; on the rims for points within
/// tolerance_mm of the base plane and another surface.
Vec3 project_to_wall_surface(const IdealisedBiventricle& shape, double tolerance_mm, const Vec3& x);

/// The surface that three boundary points lie on: kBase where all are on the base plane, else the one
/// whose farthest point is nearest.
int surface_label(const IdealisedBiventricle& shape, double tolerance_mm,
                  const std::array<Vec3, 3>& triangle);

/// Region of a point in the wall: kLvWall, kRvWall outside the left outer ellipsoid, or kSeptum where the way
/// outwards through the left wall ends in the right cavity.
int wall_region(const IdealisedBiventricle& shape, const Vec3& x);

}  // namespace cardiac
