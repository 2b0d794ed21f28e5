#include "read_heart.hpp"

#include <algorithm>
#include <charconv>

#include <cardiac/protocol/names.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/mesh_io/read.hpp>

#ifdef CARDIAC_WITH_VTK
#include <polyaffine/vtk/read_data.hpp>
#else
#include <polyaffine/mesh_io/vtu.hpp>
#endif

namespace cardiac::app {

using polyaffine::InputError;
using polyaffine::MeshData;

protocol::LengthUnit length_unit(const std::string& word) {
  const auto names = protocol::names_of(protocol::LengthUnit{});
  const auto found = std::ranges::find(names, word);
  if (found == names.end())
    throw InputError("--length-unit: found \"" + word +
                     "\", expected the length unit of the mesh: mm, cm, m or um");
  return static_cast<protocol::LengthUnit>(found - names.begin());
}

std::vector<SurfaceLabel> surface_labels(const std::vector<std::string>& words) {
  std::vector<SurfaceLabel> out;
  for (const std::string& word : words) {
    int number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error == std::errc() && end == word.data() + word.size())
      out.emplace_back(number);
    else
      out.emplace_back(word);
  }
  return out;
}

MeshData read_any_mesh(const std::filesystem::path& file) {
  if (polyaffine::has_reader(file)) return polyaffine::read_mesh_data(file);
  const std::string extension = file.extension().string();
  if (extension != ".vtu" && extension != ".vtk" && extension != ".vtp")
    throw InputError(
        file.string() + ": found the extension \"" + extension +
        "\", expected a mesh: .vtu, .vtk, .msh, .pts, .elem, or a closed surface: .stl, .off, .obj, "
        ".ply, .vtp");
#ifdef CARDIAC_WITH_VTK
  return polyaffine::read_vtk_data(file);
#else
  if (extension == ".vtu") return polyaffine::read_vtu_data(file);
  throw InputError(file.string() +
                   ": this build reads of VTK's files only .vtu (CMake option POLYAFFINE_WITH_VTK)");
#endif
}

HeartMesh read_heart(const std::filesystem::path& file, const std::filesystem::path& surface_file,
                     const HeartMeshOptions& options) {
  MeshData volume = read_any_mesh(file);
  if (surface_file.empty()) return make_heart_mesh(std::move(volume), nullptr, options);
  const MeshData surface = read_any_mesh(surface_file);
  return make_heart_mesh(std::move(volume), &surface, options);
}

}  // namespace cardiac::app
