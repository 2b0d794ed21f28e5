#pragma once

#include <polyaffine/mesh_io/mesh_data.hpp>

namespace polyaffine {

/// Reads a Gmsh mesh (.msh), version 2.2 or 4.1, text or binary (Geuzaine, Remacle 2009; Gmsh reference
/// manual, "MSH file format").
///
/// Physical groups become the triangle field "physical" (0 without a group) and the tet field "region", their
/// names surface_names and region_names; the numbers of geometrical entities the triangle field
/// "geometrical"; $NodeData and $ElementData that cover all points or tets become fields. Tetrahedra and
/// triangles may be quadratic. Throws InputError naming file and line when the file is damaged, cut off, of
/// another version, or holds other cells than tetrahedra, triangles, lines and points.
MeshData read_gmsh(const std::filesystem::path& file);

}  // namespace polyaffine
