#include "cardiac/anatomy/tet_regions.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>

#include <polyaffine/core/error.hpp>
#include <polyaffine/mesh_io/label_fields.hpp>

namespace cardiac {
namespace {

using polyaffine::InputError;
using polyaffine::Matrix;
using polyaffine::MeshData;

constexpr std::array kUsualNames{"region",    "regions",  "regionid",      "region_id",     "material",
                                 "materials", "tissue",   "tissues",       "elemtag",       "tag",
                                 "tags",      "label",    "labels",        "physical",      "gmsh:physical",
                                 "medit:ref", "celltags", "cellentityids", "modelregionid", "domain"};

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

bool whole_numbers(const Matrix& field) {
  return field.rows() == 1 && (field.array() == field.array().round()).all() &&
         (field.array().abs() < 1e9).all();
}

/// The array of the regions; empty without one.
std::string region_array(const MeshData& data, const std::string& wanted) {
  if (!wanted.empty()) return data.tet_fields.contains(wanted) ? wanted : "";
  for (const char* usual : kUsualNames)
    for (const auto& [name, field] : data.tet_fields)
      if (lower(name) == usual && whole_numbers(field)) return name;
  return "";
}

std::map<int, std::string> names_in(const MeshData& data, const std::string& array) {
  return array == "region" ? data.region_names : std::map<int, std::string>{};
}

std::string text(int number, const std::map<int, std::string>& names) {
  const auto name = names.find(number);
  return std::to_string(number) + (name == names.end() ? "" : " \"" + name->second + '"');
}

std::string listed(const std::map<int, Eigen::Index>& counts, const std::map<int, std::string>& names) {
  std::string out;
  for (const auto& [number, count] : counts)
    out += (out.empty() ? "" : ", ") + text(number, names) + " (" + std::to_string(count) + " tets)";
  return out;
}

std::map<int, Eigen::Index> counts_of(const std::vector<int>& regions) {
  std::map<int, Eigen::Index> out;
  for (const int region : regions) ++out[region];
  return out;
}

[[noreturn]] void fail_without_regions(const MeshData& data, const std::string& wanted) {
  std::string arrays;
  for (const auto& [name, field] : data.tet_fields)
    if (field.rows() == 1) arrays += (arrays.empty() ? "\"" : ", \"") + name + '"';
  throw InputError(data.source.string() + ": found no array with the regions of the tets" +
                   (wanted.empty() ? "" : " named \"" + wanted + '"') + " (their arrays of one number: " +
                   (arrays.empty() ? "none" : arrays) + "), expected one; region_array names it");
}

}  // namespace

void keep_regions(MeshData& data, const RegionChoice& choice) {
  if (choice.wanted.empty()) return;
  const std::string array = region_array(data, choice.array);
  if (array.empty()) fail_without_regions(data, choice.array);
  const std::vector<int> region = polyaffine::integer_field(data, data.tet_fields, array);
  const auto names = names_in(data, array);
  const auto counts = counts_of(region);
  const std::set<int> numbers(region.begin(), region.end());
  std::map<int, Eigen::Index> kept, left = counts;
  for (const SurfaceLabel& wanted : choice.wanted) {
    const std::vector<int> found = matching_labels(wanted, numbers, names);
    if (found.empty())
      throw InputError(data.source.string() + ": found no tet of the region " + label_text(wanted) +
                       " (regions found: " + listed(counts, names) + "), expected one of them");
    for (const int n : found) {
      kept[n] = counts.at(n);
      left.erase(n);
    }
  }
  std::vector<int> chosen;
  for (std::size_t t = 0; t < region.size(); ++t)
    if (kept.contains(region[t])) chosen.push_back(static_cast<int>(t));
  data.tets = polyaffine::Tets(data.tets(Eigen::all, chosen));
  for (auto& [name, field] : data.tet_fields) field = Matrix(field(Eigen::all, chosen));
  data.notes.push_back("region " + listed(kept, names) + " kept" +
                       (left.empty() ? "" : ", " + listed(left, names) + " left out"));
}

std::string regions_in_words(const MeshData& data, const std::string& array) {
  const std::string found = region_array(data, array);
  if (found.empty() || !whole_numbers(data.tet_fields.at(found))) return "";
  const auto counts = counts_of(polyaffine::integer_field(data, data.tet_fields, found));
  return counts.size() < 2 ? "" : listed(counts, names_in(data, found));
}

}  // namespace cardiac
