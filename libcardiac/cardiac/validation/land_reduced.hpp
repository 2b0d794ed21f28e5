#pragma once

#include <string>

#include <cardiac/validation/land_model.hpp>

namespace cardiac {

/// Problem 2 (passive) or 3 (contracting) of Land et al. 2015 by the reduced model of 17 control nodes, with
/// Land's fibres and a bulk modulus of 1000 C; values and times as solve_land_ellipsoid, unknowns those of
/// the frames. Settings key=value choose preset, axes and the like. Throws ComputationError when the load
/// path ends early.
LandSolution solve_land_reduced(const polyaffine::TetMesh& mesh, bool contracting,
                                const std::vector<std::string>& settings);

}  // namespace cardiac
