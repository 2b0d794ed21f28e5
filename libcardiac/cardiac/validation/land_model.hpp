#pragma once

#include <vector>

#include <polyaffine/mesh/tet_mesh.hpp>

namespace cardiac {

/// A solved problem of Land et al. 2015 (Proc. R. Soc. A 471, 20150641).
struct LandSolution {
  int tets = 0, unknowns = 0;
  int load_steps = 0, newton_iterations = 0;  ///< of the whole load path
  std::vector<double> values;                 ///< see the functions below
  /// Volume of the deformed wall over that at rest, minus one, both from the closed surface by the divergence
  /// theorem.
  double wall_volume_change = 0;
  double cpu_s = 0;  ///< user and system time of one thread from the mesh to the values
  double wall_s = 0;
};

/// Problem 1 on a mesh of the box 10 × 1 × 1 mm (labels 1: x = 0, 5: z = 0). Values: z of the deformed point
/// (10, 0.5, 1), mm.
///
/// All problems: quadratic tets with one pressure an element, det F = 1 in the mean of each; the law takes
/// the full strain, and κ/2 (det F − 1)² with κ = 4 C keeps the volume near that mean within an element;
/// load in steps from rest. Throws ComputationError when the load path ends early.
LandSolution solve_land_beam(const polyaffine::TetMesh& mesh);

/// Problem 2 (passive) or 3 (contracting) on a mesh of land_ellipsoid(). Values: z of the apex of the
/// endocardium and of the epicardium, mm, and the volume between endocardium and base plane, mm³.
LandSolution solve_land_ellipsoid(const polyaffine::TetMesh& mesh, bool contracting);

}  // namespace cardiac
