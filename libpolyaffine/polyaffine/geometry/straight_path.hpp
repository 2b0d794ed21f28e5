#pragma once

#include <vector>

#include <polyaffine/geometry/eikonal.hpp>

namespace polyaffine {

/// Time to travel on the straight line from a place in the mesh to a vertex, ∫ |dx|_{D⁻¹} over the tets it
/// crosses; +∞ when the line leaves the mesh or the allowed tets, or only grazes their boundary so that
/// rounding decides. The line is one path among all, so the time is an upper bound of the first arrival.
double straight_time(const EikonalSolver& solver, const MeshPoint& from, int vertex,
                     const std::vector<char>& allowed = {});

}  // namespace polyaffine
