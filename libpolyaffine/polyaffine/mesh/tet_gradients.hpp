#pragma once

#include <vector>

#include <polyaffine/mesh/tet_mesh.hpp>

namespace polyaffine {

/// The gradient F = ∂x/∂X of every tet when the vertices of a mesh (X) move to `points` (x, mm), linear
/// between them.
std::vector<Mat3> tet_gradients(const TetMesh& mesh, const Points& points);

/// The same at every vertex: the mean over the tets about it by their volumes.
std::vector<Mat3> vertex_gradients(const TetMesh& mesh, const Points& points);

/// Smallest volume of a tet over that in the mesh, min det F; not above 0 where one has turned inside out.
double least_volume_ratio(const TetMesh& mesh, const Points& points);

}  // namespace polyaffine
