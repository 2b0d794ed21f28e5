#pragma once

#include <map>
#include <utility>
#include <vector>

#include <polyaffine/mesh/tet_mesh.hpp>

namespace polyaffine {

/// Positions (mm) of the midpoints of boundary edges, by their two vertices in ascending order; edges that
/// are not in it are straight.
using EdgeMidpoints = std::map<std::pair<int, int>, Vec3>;

/// Midpoints that make quadratic elements follow the smooth surface behind a faceted one. Each labelled
/// surface gets vertex normals n (area weighted); an edge (a, b) on it is bent by −⅛ [((b−a)·n_a) n_a +
/// ((a−b)·n_b) n_b] (cubic edges of Vlachos et al. 2001 at their middle; third order on smooth surfaces). An
/// edge between two labels is bent along both surfaces at once. Unlabelled faces stay flat. Edges of tets
/// that would turn over stay straight.
EdgeMidpoints smooth_midpoints(const TetMesh& mesh);

}  // namespace polyaffine
