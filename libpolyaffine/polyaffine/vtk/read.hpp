#pragma once

#include <polyaffine/mesh_io/assemble.hpp>

namespace polyaffine {

/// What to take from a mesh file beside its tetrahedra.
struct ReadOptions {
  /// Cell array with the integer labels of the triangles; empty: the first of the usual names (label_field).
  std::string label_array{};
  /// A second file (.vtu or .vtp) with the labelled triangles; empty: those of the mesh file, if any.
  std::filesystem::path surface_file{};
  /// Also bring the numeric point and cell arrays (fibre vectors, segments, …).
  bool fields = false;
};

/// Reads a VTK file of tetrahedra (read_vtu_data, read_vtk_data) and the labels of its surface and makes it a
/// valid mesh (assemble). Coordinates are multiplied by mm_per_unit (1 for mm, 10 for cm, 1000 for m). Throws
/// InputError as these, and when triangles that were asked for have no labels.
MeshFile read_mesh_file(const std::filesystem::path& path, double mm_per_unit,
                        const ReadOptions& options = {});

/// The mesh alone; see read_mesh_file.
TetMesh read_vtu(const std::filesystem::path& path, double mm_per_unit, const ReadOptions& options = {});

}  // namespace polyaffine
