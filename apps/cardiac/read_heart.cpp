#include "read_heart.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

#include <cardiac/anatomy/idealised.hpp>
#include <cardiac/protocol/names.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/mesh_io/file_extension.hpp>
#include <polyaffine/mesh_io/label_fields.hpp>
#include <polyaffine/mesh_io/read.hpp>

#ifdef CARDIAC_WITH_VTK
#include <polyaffine/vtk/read_data.hpp>
#endif

namespace cardiac::app {

using polyaffine::InputError;
using polyaffine::MeshData;

namespace {

std::string name_note(const std::filesystem::path& file, int surface) {
  return file.filename().string() + " is the " + surface_title(surface) + " by its name";
}

/// Adds the triangles of a file with one label for all of them.
void append(MeshData& to, const MeshData& from, int label) {
  const Eigen::Index points = to.points.cols(), triangles = to.triangles.cols();
  to.points.conservativeResize(3, points + from.points.cols());
  to.points.rightCols(from.points.cols()) = from.points;
  to.triangles.conservativeResize(3, triangles + from.triangles.cols());
  to.triangles.rightCols(from.triangles.cols()) = from.triangles.array() + static_cast<int>(points);
  polyaffine::Matrix& labels = to.triangle_fields["surface"];
  labels.conservativeResize(1, triangles + from.triangles.cols());
  labels.rightCols(from.triangles.cols()).setConstant(label);
}

/// The heart with surfaces of one file each.
HeartMesh read_separate(MeshData volume, const SurfaceFiles& surfaces, HeartMeshOptions options) {
  const SurfaceLabelMap& map = options.labels;
  if (!options.label_array.empty() || !map.endo.empty() || !map.epi.empty() || !map.base.empty() ||
      !map.rv_endo.empty())
    throw InputError(
        "surface files: found labels beside files of one surface each, expected labels only with "
        "one labelled file");
  MeshData all;
  std::string source;
  options.labels.rest_is_base = true;
  for (const auto& [label, file] : surfaces.of_surface) {
    const MeshData one = read_any_mesh(file);
    if (one.triangles.cols() == 0)
      throw InputError(file.string() + ": found no triangles, expected those of a surface");
    append(all, one, label);
    source += (source.empty() ? "" : ", ") + file.string();
    if (label == kBase) options.labels.rest_is_base = false;
  }
  for (const auto& [label, name] : {std::pair{kEndocardium, "endo"}, {kEpicardium, "epi"}})
    if ((all.triangle_fields.at("surface").array() != label).all())
      throw InputError(source + ": found no file of the surface \"" + name +
                       "\", expected NAME=FILE for endo and epi, and base where it is not the rest");
  all.source = source;
  all.notes = surfaces.notes;
  if (options.labels.rest_is_base)
    all.notes.emplace_back("no file of the base: the rest of the boundary is base");
  options.label_array = "surface";
  return make_heart_mesh(std::move(volume), &all, options);
}

}  // namespace

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
  const std::string extension = polyaffine::lower_extension(file);
  if (extension != ".vtk" && extension != ".vtp")
    throw InputError(
        file.string() + ": found the extension \"" + file.extension().string() +
        "\", expected a mesh: .vtu, .vtk, .msh, .pts, .elem, or a closed surface: .stl, .off, .obj, "
        ".ply, .vtp");
#ifdef CARDIAC_WITH_VTK
  return polyaffine::read_vtk_data(file);
#else
  throw InputError(file.string() +
                   ": this build reads of VTK's files only .vtu (CMake option POLYAFFINE_WITH_VTK)");
#endif
}

SurfaceFiles surface_files(const std::vector<std::string>& words) {
  SurfaceFiles out;
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos && words.size() == 1) {
      out.labelled = word;
      return out;
    }
    const std::filesystem::path file = equals == std::string::npos ? word : word.substr(equals + 1);
    const std::string name = equals == std::string::npos ? file.stem().string() : word.substr(0, equals);
    const std::optional<int> surface = surface_of_name(name);
    if (!surface)
      throw InputError("surface files: found \"" + word +
                       "\", expected NAME=FILE with the name of a surface " +
                       "(endo, epi, base, rv_endo) for each of several files, or one labelled file alone");
    if (equals == std::string::npos) out.notes.push_back(name_note(file, *surface));
    out.of_surface.emplace_back(*surface, file);
  }
  return out;
}

HeartMesh read_heart(MeshData volume, const SurfaceFiles& surfaces, const HeartMeshOptions& options) {
  if (surfaces.of_surface.empty() && surfaces.labelled.empty())
    return make_heart_mesh(std::move(volume), nullptr, options);
  if (!surfaces.of_surface.empty()) return read_separate(std::move(volume), surfaces, options);
  MeshData surface = read_any_mesh(surfaces.labelled);
  const bool labelled = !options.label_array.empty() || !polyaffine::label_field(surface, "").empty() ||
                        !surface.point_fields.empty();
  const std::optional<int> named = surface_of_name(surfaces.labelled.stem().string());
  if (labelled || !named) return make_heart_mesh(std::move(volume), &surface, options);
  return read_separate(std::move(volume),
                       {{}, {{*named, surfaces.labelled}}, {name_note(surfaces.labelled, *named)}}, options);
}

}  // namespace cardiac::app
