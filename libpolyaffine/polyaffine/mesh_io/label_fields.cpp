#include "polyaffine/mesh_io/label_fields.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>

#include <polyaffine/core/error.hpp>

namespace polyaffine {
namespace {

[[noreturn]] void fail(const MeshData& data, const std::string& what) {
  throw InputError(data.source.string() + ": " + what);
}

constexpr std::array kUsualNames{"surface",    "label",         "labels",    "tag",           "tags",
                                 "physical",   "gmsh:physical", "medit:ref", "cellentityids", "modelfaceid",
                                 "facet_tags", "markers",       "boundary",  "elemtag"};

std::string names_of(const std::map<std::string, Matrix>& fields) {
  std::string names;
  for (const auto& [name, field] : fields) names += (names.empty() ? "\"" : ", \"") + name + '"';
  return names.empty() ? "none" : names;
}

[[noreturn]] void fail_without_labels(const MeshData& data, const std::string& expected) {
  fail(data, "found no label array for the surface triangles (cell arrays: " +
                 names_of(data.triangle_fields) + "; point arrays: " + names_of(data.point_fields) +
                 "), expected an integer array named " + expected);
}

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

}  // namespace

std::string label_field(const MeshData& data, const std::string& wanted) {
  if (!wanted.empty()) {
    if (data.triangle_fields.contains(wanted)) return wanted;
    fail_without_labels(data, '"' + wanted + '"');
  }
  for (const char* usual : kUsualNames)
    for (const auto& [name, field] : data.triangle_fields)
      if (lower(name) == usual && field.rows() == 1) return name;
  return "";
}

std::vector<int> integer_field(const MeshData& data, const std::map<std::string, Matrix>& fields,
                               const std::string& name) {
  const Matrix& field = fields.at(name);
  if (field.rows() != 1)
    fail(data, "array \"" + name + "\": found " + std::to_string(field.rows()) +
                   " components, expected one integer");
  std::vector<int> out;
  out.reserve(field.cols());
  for (const double value : field.reshaped()) {
    if (!(std::abs(value) <= std::numeric_limits<int>::max()) || value != std::round(value))
      fail(data, "array \"" + name + "\", entry " + std::to_string(out.size()) + ": found " +
                     std::to_string(value) + ", expected an integer");
    out.push_back(static_cast<int>(value));
  }
  return out;
}

SurfaceData labelled_surface(const MeshData& data, const std::string& wanted) {
  const std::string name = label_field(data, wanted);
  if (name.empty()) fail_without_labels(data, "\"surface\", \"label\", \"tag\" or \"physical\"");
  Matrix numbers = data.triangle_fields.at(name);
  const auto none = numbers.array().isNaN().count();
  SurfaceData out{data};
  if (none > 0) {
    numbers = numbers.array().isNaN().select(0, numbers);
    out.notes.push_back(std::to_string(none) + " triangles whose label is not a number taken as unlabelled");
  }
  out.labels = integer_field(data, {{name, numbers}}, name);
  return out;
}

}  // namespace polyaffine
