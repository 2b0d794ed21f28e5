#include "cardiac/anatomy/triangle_labels.hpp"

#include <algorithm>

#include <cardiac/anatomy/idealised.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/mesh/tet_mesh.hpp>
#include <polyaffine/mesh_io/point_labels.hpp>

namespace cardiac {
namespace {

using polyaffine::MeshData;

constexpr const char* kCobiveco = "class";  // Schuler 2021, vtk files of the tool Cobiveco
const std::map<int, std::string>& cobiveco_names() {
  static const std::map<int, std::string> names{{1, "base"}, {2, "epi"}, {3, "lv_endo"}, {4, "rv_endo"}};
  return names;
}

bool is_cobiveco(const MeshData& data) {
  const auto field = data.point_fields.find(kCobiveco);
  return field != data.point_fields.end() && field->second.rows() == 1 &&
         (field->second.array() >= 0).all() && (field->second.array() <= 4).all() &&
         (field->second.array() == field->second.array().round()).all();
}

/// Where labels are; those of points are made labels of triangles.
std::string array_of(MeshData& data, const std::string& wanted, std::map<int, std::string>& names) {
  std::string array = wanted;
  const bool of_triangles = data.triangles.cols() > 0 && data.triangle_fields.contains(wanted);
  if (wanted.empty()) {
    array = data.triangles.cols() > 0 ? polyaffine::label_field(data, "") : "";
    if (array.empty() && is_cobiveco(data)) array = kCobiveco;
    if (array.empty() || array != kCobiveco) {
      if (array == "physical") names = data.surface_names;
      return array;
    }
  } else if (of_triangles || !data.point_fields.contains(wanted)) {
    if (array == "physical") names = data.surface_names;
    return polyaffine::label_field(data, wanted);
  }
  polyaffine::label_triangles_by_points(data, array);
  if (is_cobiveco(data) && array == kCobiveco) {
    names = cobiveco_names();
    if (wanted.empty())
      data.notes.emplace_back("labels \"class\" of points are read as Cobiveco's: 1 base, 2 epi, 3 lv, 4 rv");
  }
  return array;
}

/// Point arrays that could hold surfaces: a few whole numbers.
void note_unused(const MeshData& data, std::vector<std::string>& notes) {
  constexpr std::size_t kMostSurfaces = 20;
  for (const auto& [name, field] : data.point_fields) {
    if (field.rows() != 1 || !(field.array() == field.array().round()).all()) continue;
    const std::set<double> values(field.reshaped().begin(), field.reshaped().end());
    if (values.size() >= 2 && values.size() <= kMostSurfaces)
      notes.push_back("point array \"" + name + "\" of " + std::to_string(values.size()) +
                      " whole numbers not used: name it as the label array if it holds the surfaces");
  }
}

std::string quantity(int label, std::ptrdiff_t triangles, const std::map<int, std::string>& names) {
  const auto name = names.find(label);
  return std::to_string(triangles) + " triangles with label " + std::to_string(label) +
         (name == names.end() ? "" : " \"" + name->second + '"');
}

}  // namespace

TriangleLabels read_triangle_labels(MeshData& data, const std::string& label_array,
                                    const SurfaceLabelMap& map) {
  TriangleLabels out;
  std::map<int, std::string> names;
  out.array = array_of(data, label_array, names);
  if (!out.array.empty()) {
    polyaffine::SurfaceData surface = polyaffine::labelled_surface(data, out.array);
    out.labels = std::move(surface.labels);
    out.notes = std::move(surface.notes);
  } else {
    note_unused(data, out.notes);
  }
  std::set<int> numbers(out.labels.begin(), out.labels.end());
  numbers.erase(polyaffine::TetMesh::kUnlabelled);
  std::map<int, int> meaning;
  try {
    SurfaceLabelMap without_base = map;
    without_base.rest_is_base = true;
    meaning = heart_labels(numbers, names, without_base);
    try {
      meaning = heart_labels(numbers, names, map);
    } catch (const polyaffine::InputError& error) {
      out.base_missing = error.what();
    }
  } catch (const polyaffine::InputError& error) {
    throw polyaffine::InputError(data.source.string() + ": " + error.what());
  }
  out.known = !meaning.empty();
  if (!out.known) {
    out.optional = numbers;
    return out;
  }
  if (map.rv_endo.empty()) out.optional = {kRvEndocardium};
  for (const int n : numbers)
    if (!meaning.contains(n))
      out.notes.push_back(quantity(n, std::ranges::count(out.labels, n), names) +
                          " left out: no surface of a ventricle");
  for (int& label : out.labels) {
    const auto found = meaning.find(label);
    label = found == meaning.end() ? polyaffine::TetMesh::kUnlabelled : found->second;
  }
  return out;
}

}  // namespace cardiac
