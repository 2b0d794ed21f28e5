#pragma once

#include <polyaffine/mesh_io/mesh_data.hpp>

namespace polyaffine {

/// Reads a VTK XML unstructured grid (.vtu): tetrahedra and triangles, linear or quadratic, and all numeric
/// point and cell arrays; as text, base64 or raw bytes, plain or compressed by zlib, in either byte order and
/// any number of pieces, which follow each other. Vertices and lines are passed over. Throws InputError,
/// naming file and mostly line, when it is missing, damaged, or holds what is not read (other cells,
/// compression by lz4 or lzma).
MeshData read_vtu_data(const std::filesystem::path& file);

}  // namespace polyaffine
