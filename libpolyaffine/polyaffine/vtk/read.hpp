#pragma once

#include <filesystem>
#include <map>
#include <string>

#include <polyaffine/mesh/tet_mesh.hpp>

namespace polyaffine {

/// What to take from a mesh file beside its tetrahedra.
struct ReadOptions {
  /// Cell array with the integer labels of the triangles; empty: the first of "surface", "label", "tag".
  std::string label_array{};
  /// A second file (.vtu or .vtp) with the labelled triangles; empty: those of the mesh file, if any.
  std::filesystem::path surface_file{};
  /// Also bring the numeric point and cell arrays (fibre vectors, segments, …).
  bool fields = false;
};

/// A mesh and the fields of its file: each field components × points, or components × tets. The cell arrays
/// "surface" and "region" are part of the mesh, not fields.
struct MeshFile {
  TetMesh mesh;
  std::map<std::string, Matrix> point_fields, cell_fields;
};

/// Reads linear tetrahedra (VTK_TETRA) of a .vtu file and, where there are any, labelled triangles
/// (VTK_TRIANGLE).
///
/// Coordinates are multiplied by mm_per_unit (1 for mm, 10 for cm, 1000 for m). The integer cell array
/// "region", if present, gives the region label of each tet. Triangles on points of their own are joined to
/// the tets by coordinates (within 1e-5 of the size of the mesh). Points that no tet uses are dropped. Fields
/// keep their values and units.
/// Throws InputError, naming the file, when it is missing, is not .vtu, is damaged, holds other cells, misses
/// the label array, holds a number that is not finite, has triangles away from the boundary, or is no valid
/// TetMesh.
MeshFile read_mesh_file(const std::filesystem::path& path, double mm_per_unit,
                        const ReadOptions& options = {});

/// The mesh alone; see read_mesh_file.
TetMesh read_vtu(const std::filesystem::path& path, double mm_per_unit, const ReadOptions& options = {});

}  // namespace polyaffine
