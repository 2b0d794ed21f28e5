#pragma once

#include <polyaffine/mesh_io/mesh_data.hpp>

namespace polyaffine {

/// Does read_vtk_data know the extension (.vtk, .vtp)?
bool is_vtk_file(const std::filesystem::path& file);

/// Reads by VTK a legacy file with an unstructured grid or polydata (.vtk), or XML polydata (.vtp; .vtu is
/// read by read_vtu_data): tetrahedra and triangles, linear or quadratic, and all numeric point and cell
/// arrays. Vertices and lines are passed over. Throws InputError, naming the file, when it is missing,
/// damaged, or holds other cells.
MeshData read_vtk_data(const std::filesystem::path& file);

}  // namespace polyaffine
