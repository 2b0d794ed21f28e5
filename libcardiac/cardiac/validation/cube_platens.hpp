#pragma once

#include <string>

#include <cardiac/validation/cube_scene.hpp>

namespace cardiac {

/// The cube between two platens on which it cannot slip: top and bottom move rigidly along z, the sides are
/// free and bulge. Small strain: the platens approach a little, and the change of thickness is scaled to a
/// force of 2000 N.
struct PlatenSolution {
  double thickness_change_mm = 0;
  polyaffine::Points displacement;  ///< at the centroids of the tets, for the same approach
  std::shared_ptr<const polyaffine::Basis> basis;
  polyaffine::Vector c;  ///< coefficients of the basis, for the same approach
  int integration_points = 0, newton_iterations = 0;
  double setup_s = 0, solve_s = 0;  ///< processor time, of functions and energy and of Newton
};

/// Linear tetrahedra.
PlatenSolution solve_platens_linear(const CubeScene& scene);
/// Quadratic tetrahedra with one mean dilatation each: the truth here.
PlatenSolution solve_platens_quadratic(const CubeScene& scene);

/// Affine frames times 4 z (h − z)/h², which vanishes on the platens, and as the last function z/h, whose
/// coefficient is the displacement of the upper platen: no coefficient can slip on a platen.
std::shared_ptr<const polyaffine::Basis> platen_basis(const CubeScene& scene, const CubePlacement& placement);

/// The frames of platen_basis with consistent weights. Against locking the volume is kept by one mean
/// dilatation a zone (region_pressure) with κ − κ_loc, and by κ_loc = 4 μ at the points, without which one
/// pressure leaves the dilatation of twelve unknowns too free.
PlatenSolution solve_platens_reduced(const CubeScene& scene, const CubePlacement& placement);

/// L2 error of a displacement at the centroids of the truth's tets (for the same approach) relative to the
/// bulge: the true displacement beside homogeneous compression.
double platen_error_percent(const CubeScene& scene, const PlatenSolution& truth,
                            const polyaffine::Points& displacement);

/// Errors against the truth of one number of zones, means over placements.
struct PlatenRow {
  int zones = 0, points = 0, unknowns = 0, placements = 0, redraws = 0;
  double thickness_error_percent = 0;     ///< mean absolute value
  double displacement_error_percent = 0;  ///< platen_error_percent
};

PlatenRow compare_platens(const CubeScene& scene, const PlatenSolution& truth, int zones, int points,
                          int placements);

std::string platens_csv(const std::vector<PlatenRow>& rows);

}  // namespace cardiac
