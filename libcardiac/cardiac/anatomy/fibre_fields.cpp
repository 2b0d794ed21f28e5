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

void keep(polyaffine::MeshData& data, std::map<std::string, polyaffine::Matrix>& fields, bool of_tets,
          bool all) {
  std::map<std::string, polyaffine::Matrix> kept;
  for (auto& [name, field] : fields) {
    const std::string fibre = field.rows() == 3 ? fibre_name(name) : "";
    if (!fibre.empty()) {
      check_lengths(data, name, field, of_tets);
      data.notes.push_back("field \"" + name + "\" kept" + (name == fibre ? "" : " as \"" + fibre + '"') +
                           (of_tets ? " of tets" : " of points"));
    }
    if (!fibre.empty() || all || (of_tets && name == "region"))
      kept[fibre.empty() ? name : fibre] = std::move(field);
  }
  fields = std::move(kept);
}

}  // namespace

void keep_fibre_fields(polyaffine::MeshData& data, bool all) {
  keep(data, data.point_fields, false, all);
  keep(data, data.tet_fields, true, all);
}

}  // namespace cardiac
