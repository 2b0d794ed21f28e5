#pragma once

#include <set>

#include <polyaffine/mesh_io/mesh_data.hpp>

namespace polyaffine {

/// Triangles with labels in the data of a mesh or of a second file; label 0 is none.
struct SurfaceData {
  const MeshData& data;
  std::vector<int> labels{};  ///< one for each triangle of the data, or none at all
  /// Labels whose triangles need not be faces of the mesh, as caps over openings or parts of a larger whole.
  std::set<int> optional{};
  std::vector<std::string> notes{};  ///< what of the labels was left out
};

/// The name of the triangle field that holds labels: `wanted`, or, if that is empty, the first of the usual
/// names ("surface", "label", "tag", "physical", "CellEntityIds", …; any case); empty without one. Throws
/// InputError naming the fields of triangles and points when the wanted one is not there.
std::string label_field(const MeshData& data, const std::string& wanted);

/// The values of a field as integers. Throws InputError, naming file and field, where they are none.
std::vector<int> integer_field(const MeshData& data, const std::map<std::string, Matrix>& fields,
                               const std::string& name);

/// The triangles with the labels of label_field; a label that is not a number (NaN) is none, with a note.
/// Throws InputError when there is no such field, or a label is no integer.
SurfaceData labelled_surface(const MeshData& data, const std::string& wanted);

}  // namespace polyaffine
