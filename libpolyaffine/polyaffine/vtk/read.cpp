#include "polyaffine/vtk/read.hpp"

#include <polyaffine/core/error.hpp>
#include <polyaffine/mesh_io/file_extension.hpp>
#include <polyaffine/mesh_io/vtu.hpp>
#include <polyaffine/vtk/read_data.hpp>

namespace polyaffine {

using std::filesystem::path;

MeshFile read_mesh_file(const path& file, double mm_per_unit, const ReadOptions& options) {
  const auto checked = [](const path& name, const char* expected) {
    if (lower_extension(name) == ".vtu") return read_vtu_data(name);
    if (!is_vtk_file(name))
      throw InputError(name.string() + ": found the extension \"" + name.extension().string() +
                       "\", expected " + expected);
    return read_vtk_data(name);
  };
  MeshData volume = checked(file, ".vtu or .vtk");
  if (!options.fields) {
    volume.point_fields.clear();
    std::erase_if(volume.tet_fields, [](const auto& field) { return field.first != "region"; });
  }
  const bool own = options.surface_file.empty();
  const MeshData second = own ? MeshData{} : checked(options.surface_file, ".vtu, .vtk or .vtp");
  const MeshData& surface = own ? volume : second;
  if (surface.triangles.cols() == 0) {
    if (!own || !options.label_array.empty())
      throw InputError(surface.source.string() + ": found no triangles, expected labelled surface triangles");
    return assemble(volume, {volume}, mm_per_unit);
  }
  return assemble(volume, labelled_surface(surface, options.label_array), mm_per_unit);
}

TetMesh read_vtu(const path& file, double mm_per_unit, const ReadOptions& options) {
  return read_mesh_file(file, mm_per_unit, options).mesh;
}

}  // namespace polyaffine
