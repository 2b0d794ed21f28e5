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

[[noreturn]] void fail_without_labels(const MeshData& data, const std::string& expected) {
  std::string names;
  for (const auto& [name, field] : data.triangle_fields)
    names += (names.empty() ? "\"" : ", \"") + name + '"';
  fail(data, "found no label array for the surface triangles (cell arrays: " +
                 (names.empty() ? "none" : names) + "), expected an integer cell array named " + expected);
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
    fail(data, "cell array \"" + name + "\": found " + std::to_string(field.rows()) +
                   " components, expected one integer a cell");
  std::vector<int> out;
  out.reserve(field.cols());
  for (const double value : field.reshaped()) {
    if (!(std::abs(value) <= std::numeric_limits<int>::max()) || value != std::round(value))
      fail(data, "cell array \"" + name + "\", cell " + std::to_string(out.size()) + ": found " +
                     std::to_string(value) + ", expected an integer");
    out.push_back(static_cast<int>(value));
  }
  return out;
}

SurfaceData labelled_surface(const MeshData& data, const std::string& wanted) {
  const std::string name = label_field(data, wanted);
  if (name.empty()) fail_without_labels(data, "\"surface\", \"label\", \"tag\" or \"physical\"");
  return {data, integer_field(data, data.triangle_fields, name)};
}

}  // namespace polyaffine
