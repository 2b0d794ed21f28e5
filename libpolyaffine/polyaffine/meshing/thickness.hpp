#pragma once

#include <polyaffine/core/types.hpp>

namespace polyaffine {

/// Thickness (mm) of a body behind each triangle of its closed outward surface: from the triangle's centroid
/// against its normal to the next triangle.
Vector thickness_behind(const Points& points, const Triangles& triangles);

/// Where a body is thinnest.
struct ThinPlace {
  double thickness_mm = 0;
  Vec3 place = Vec3::Zero();  ///< on its surface
};
/// Of the thicknesses of the triangles that a hundredth of the surface lies behind, so that a few triangles
/// beside a sharp edge do not speak for the body.
ThinPlace thinnest_place(const Points& points, const Triangles& triangles);

}  // namespace polyaffine
