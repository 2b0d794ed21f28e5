#include "cardiac/anatomy/fibre_fields.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <sstream>

#include <polyaffine/core/error.hpp>

namespace cardiac {
namespace {

struct Kind {
  const char* name;
  std::vector<const char*> usual;  ///< lower case
};

const std::array<Kind, 3>& kinds() {
  static const std::array<Kind, 3> all{
      {{"fibre", {"fibre", "fibres", "fiber", "fibers", "fibre_direction", "fiber_direction", "f0", "f"}},
       {"sheet", {"sheet", "sheets", "sheet_direction", "s0", "s"}},
       {"sheet_normal", {"sheet_normal", "sheetnormal", "sheet-normal", "n0", "n"}}}};
  return all;
}

/// The name that the field shall have; empty when it is none of fibres.
std::string fibre_name(std::string name) {
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::tolower(c); });
  for (const Kind& kind : kinds())
    for (const char* usual : kind.usual)
      if (name == usual) return kind.name;
  return "";
}

void check_lengths(const polyaffine::MeshData& data, const std::string& name, const polyaffine::Matrix& field,
                   bool of_tets) {
  for (Eigen::Index i = 0; i < field.cols(); ++i) {
    if (!(field.col(i).norm() < 1e-6)) continue;
    const polyaffine::Vec3 x =
        of_tets ? polyaffine::Vec3(data.points(Eigen::all, data.tets.col(i)).rowwise().mean())
                : polyaffine::Vec3(data.points.col(i));
    std::ostringstream text;
    text << data.source.string() << ": array \"" << name << "\": found a vector of length "
         << field.col(i).norm() << " at " << (of_tets ? "tet " : "point ") << i << " (counted from 0) near ("
         << x.x() << ", " << x.y() << ", " << x.z()
         << ") (in the file's unit), expected fibre directions of length 1";
    throw polyaffine::InputError(text.str());
  }
}

/// What a field is to be called: of fibres, by the given arrays and the usual names; empty for others.
std::string role(const std::string& name, Eigen::Index components, const FibreArrays& arrays) {
  if (components != 3) return "";
  if (!arrays.fibre.empty() && name == arrays.fibre) return "fibre";
  if (!arrays.sheet.empty() && name == arrays.sheet) return "sheet";
  std::string usual = fibre_name(name);
  const bool taken =
      (usual == "fibre" && !arrays.fibre.empty()) || (usual == "sheet" && !arrays.sheet.empty());
  return taken ? "" : usual;
}

void keep(polyaffine::MeshData& data, std::map<std::string, polyaffine::Matrix>& fields, bool of_tets,
          const FibreArrays& arrays, bool all, std::vector<std::string>& notes) {
  std::map<std::string, polyaffine::Matrix> kept;
  for (auto& [name, field] : fields) {
    const std::string fibre = role(name, field.rows(), arrays);
    if (!fibre.empty()) {
      check_lengths(data, name, field, of_tets);
      notes.push_back("field \"" + name + "\" kept" + (name == fibre ? "" : " as \"" + fibre + '"') +
                      (of_tets ? " of tets" : " of points"));
    }
    if (!fibre.empty() || all || (of_tets && name == "region"))
      kept[fibre.empty() ? name : fibre] = std::move(field);
  }
  fields = std::move(kept);
}

void check_given(const polyaffine::MeshData& data, const std::string& name) {
  if (name.empty()) return;
  Eigen::Index components = 0;
  for (const auto* fields : {&data.point_fields, &data.tet_fields})
    if (const auto at = fields->find(name); at != fields->end()) {
      components = at->second.rows();
      if (components == 3) return;
    }
  throw polyaffine::InputError(
      data.source.string() + ": array \"" + name + "\": found " +
      (components == 0 ? "no point or cell array of this name"
                       : std::to_string(components) + (components == 1 ? " component" : " components")) +
      ", expected directions of 3 components");
}

}  // namespace

std::vector<std::string> keep_fibre_fields(polyaffine::MeshData& data, const FibreArrays& arrays, bool all) {
  check_given(data, arrays.fibre);
  check_given(data, arrays.sheet);
  std::vector<std::string> notes;
  keep(data, data.point_fields, false, arrays, all, notes);
  keep(data, data.tet_fields, true, arrays, all, notes);
  return notes;
}

}  // namespace cardiac
