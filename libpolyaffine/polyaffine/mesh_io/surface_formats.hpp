#pragma once

#include <polyaffine/mesh_io/mesh_data.hpp>

namespace polyaffine {

/// Readers of triangulated surfaces. Polygons are cut into triangles from their first corner. All throw
/// InputError naming file and line (byte count for binary files) when the file is damaged, cut off or of
/// another format.

/// STL, text or binary. Each triangle brings points of its own.
MeshData read_stl(const std::filesystem::path& file);
/// OFF in its variants (COFF, NOFF, …); what follows a coordinate or a face in its line is passed over.
MeshData read_off(const std::filesystem::path& file);
/// Wavefront OBJ: `v` and `f`; negative numbers count from the end.
MeshData read_obj(const std::filesystem::path& file);
/// PLY, text or binary of either byte order. Numeric face properties become triangle fields.
MeshData read_ply(const std::filesystem::path& file);

/// Adds a polygon as triangles.
void add_polygon(CellList& triangles, const std::vector<int>& corners);

}  // namespace polyaffine
