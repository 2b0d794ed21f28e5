#pragma once

#include <polyaffine/mesh_io/mesh_data.hpp>

namespace polyaffine {

/// Reads a VTK XML unstructured grid (.vtu) without VTK: tetrahedra and triangles, linear or quadratic, and
/// all numeric point and cell arrays; as text, base64 or raw bytes, plain or compressed by zlib, in one piece
/// and little-endian. Vertices and lines are passed over. The same as read_vtk_data gives of such a file.
/// Throws InputError, naming file and mostly line, when it is missing, damaged, or holds what it does not
/// read.
MeshData read_vtu_data(const std::filesystem::path& file);

}  // namespace polyaffine
