#pragma once

#include <cmath>

#include "support/land_ellipsoid.hpp"

namespace cardiac::testing {

/// Land's coarse ellipsoid with a ridge along the wall that stands into the cavity by `height` (mm), a
/// Gaussian of the half width 1.3 mm around it and of 7 mm along it, about mid-height.
inline polyaffine::TetMesh ridged_ellipsoid(double height) {
  const polyaffine::TetMesh& mesh = LandEllipsoid::get().mesh;
  polyaffine::Points points = mesh.points();
  for (auto X : points.colwise()) {
    const double radius = std::hypot(X.x(), X.y()), across = X.y() / 1.3, along = (X.z() + 6) / 7;
    if (X.x() <= 0 || radius == 0) continue;
    const double bump = std::exp(-across * across - along * along);
    X.head<2>() *= 1 - height * bump * (1 - analytic_depth(X)) / radius;
  }
  return {points, mesh.tets(), mesh.regions(), {mesh.boundary(), mesh.boundary_labels()}};
}

}  // namespace cardiac::testing
