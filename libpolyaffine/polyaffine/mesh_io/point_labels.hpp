#pragma once

#include <string>

#include <polyaffine/mesh_io/mesh_data.hpp>

namespace polyaffine {

/// Makes a triangle field out of the point field of the same name, and a note.
///
/// A triangle whose corners share a label has it. The others, along the borders, take one of their corners'
/// labels from a neighbour, those across flat edges first (a watershed, Meyer 1994): borders come to lie on
/// the sharp edges of the surface. Of a label that no triangle has at all its corners, the triangles with two
/// such corners have it. What no neighbour reaches takes the label of two of its corners, or of three
/// different ones that of the fewest points. A mesh of tetrahedra without triangles gets those of its
/// boundary. Throws InputError when a label is no integer.
void label_triangles_by_points(MeshData& data, const std::string& name);

}  // namespace polyaffine
