#pragma once

#include <polyaffine/meshing/implicit_domain.hpp>

namespace polyaffine {

/// Fills a closed, outward surface of triangles with tetrahedra, as mesh_implicit_domain does. Edges with
/// more than 50° between the normals of their triangles are kept. The boundary is not labelled.
///
/// Throws InputError, naming the place, when the surface meets itself or a size is not positive,
/// ComputationError when no valid mesh comes out.
TetMesh mesh_polyhedral_domain(const Points& points, const Triangles& triangles, const MeshSizes& sizes);

}  // namespace polyaffine
