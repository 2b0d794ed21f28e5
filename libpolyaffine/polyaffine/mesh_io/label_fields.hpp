#pragma once

#include <polyaffine/mesh_io/mesh_data.hpp>

namespace polyaffine {

/// Triangles with labels in the data of a mesh or of a second file; label 0 is none.
struct SurfaceData {
  const MeshData& data;
  std::vector<int> labels{};  ///< one for each triangle of the data, or none at all
};

/// The name of the triangle field that holds labels: `wanted`, or, if that is empty, the first of the usual
/// names ("surface", "label", "tag", "physical", "CellEntityIds", …; any case); empty without one. Throws
/// InputError naming the fields when the wanted one is not there.
std::string label_field(const MeshData& data, const std::string& wanted);

/// The values of a field as integers. Throws InputError, naming file and field, where they are none.
std::vector<int> integer_field(const MeshData& data, const std::map<std::string, Matrix>& fields,
                               const std::string& name);

/// The triangles with the labels of label_field. Throws InputError when there is no such field.
SurfaceData labelled_surface(const MeshData& data, const std::string& wanted);

}  // namespace polyaffine
