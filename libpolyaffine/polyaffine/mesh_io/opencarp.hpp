#pragma once

#include <polyaffine/mesh_io/mesh_data.hpp>

namespace polyaffine {

/// Reads an openCARP mesh from NAME.pts (points), NAME.elem (cells with region tags) and, if it is there,
/// NAME.lon (one fibre vector per cell, or fibre and sheet); `file` is any of the three. Tags become the
/// field "region", vectors the tet fields "fibre" and "sheet". openCARP itself takes the numbers as µm.
/// Throws InputError naming file and line for anything but tetrahedra, triangles and lines (Tt, Tr, Ln), a
/// file that is cut off, or a number that is none.
MeshData read_opencarp(const std::filesystem::path& file);

}  // namespace polyaffine
