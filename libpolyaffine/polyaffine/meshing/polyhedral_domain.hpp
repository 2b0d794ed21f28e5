#pragma once

#include <polyaffine/meshing/implicit_domain.hpp>

namespace polyaffine {

/// Fills a closed, outward surface of triangles with tetrahedra, as mesh_implicit_domain does. Edges with
/// more than 50° between the normals of their triangles are kept. The boundary is not labelled.
///
/// Where the body is thinner than the tets' edges would be long (thickness_behind), all sizes shrink with it:
/// to .7 of the thickness, at least an eighth of the sizes given, growing again by .5 mm a mm. When the
/// boundary of the tets is not of the surface's kind all the same (touches itself, has other handles or
/// another volume), it is filled again with sizes of .7 and .5.
///
/// Throws InputError, naming the place, when the surface meets itself or a size is not positive,
/// ComputationError when no valid mesh comes out; it names the thinnest place.
TetMesh mesh_polyhedral_domain(const Points& points, const Triangles& triangles, const MeshSizes& sizes);

}  // namespace polyaffine
