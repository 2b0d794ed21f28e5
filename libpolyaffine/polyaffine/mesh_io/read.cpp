#include "polyaffine/mesh_io/read.hpp"

#include <polyaffine/core/error.hpp>
#include <polyaffine/mesh_io/file_extension.hpp>
#include <polyaffine/mesh_io/gmsh.hpp>
#include <polyaffine/mesh_io/opencarp.hpp>
#include <polyaffine/mesh_io/surface_formats.hpp>
#include <polyaffine/mesh_io/vtu.hpp>

namespace polyaffine {
namespace {

using Reader = MeshData (*)(const std::filesystem::path&);

const std::map<std::string, Reader>& readers() {
  static const std::map<std::string, Reader> all{
      {".msh", read_gmsh},     {".pts", read_opencarp}, {".elem", read_opencarp},
      {".lon", read_opencarp}, {".vtu", read_vtu_data}, {".stl", read_stl},
      {".off", read_off},      {".obj", read_obj},      {".ply", read_ply}};
  return all;
}

}  // namespace

bool has_reader(const std::filesystem::path& file) {
  return readers().contains(lower_extension(file));
}

MeshData read_mesh_data(const std::filesystem::path& file) {
  const auto found = readers().find(lower_extension(file));
  if (found != readers().end()) return found->second(file);
  std::string known;
  for (const auto& [extension, reader] : readers()) known += (known.empty() ? "" : ", ") + extension;
  throw InputError(file.string() + ": found the extension \"" + file.extension().string() + "\", expected " +
                   known);
}

}  // namespace polyaffine
