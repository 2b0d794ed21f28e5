#pragma once

#include <polyaffine/mesh_io/mesh_data.hpp>

namespace polyaffine {

/// Makes of the triangles of a file the boundary of a body, oriented outwards. Points are in mm.
///
/// Repaired and noted: points in the same place joined, triangles that fall together with an edge left out,
/// the same triangle given twice, points of no triangle, orientation. Throws InputError, naming file and
/// place, for a coordinate that is not finite, a hole (an edge of one triangle), an edge of more than two
/// triangles, parts that touch in a point, a surface of several parts, or one that encloses nothing. Whether
/// it meets itself is left to the mesher.
void make_closed_surface(MeshData& data);

}  // namespace polyaffine
