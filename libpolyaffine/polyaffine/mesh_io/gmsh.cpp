#include "polyaffine/mesh_io/gmsh.hpp"

#include <algorithm>

#include <polyaffine/mesh_io/gmsh_stream.hpp>

namespace polyaffine {
namespace {

using namespace gmsh;

/// Names of the groups of triangles and of tetrahedra.
void read_names(FileScanner& scan, MeshData& data) {
  for (std::size_t i = scan.count("the number of physical groups", 4); i > 0; --i) {
    const long long dimension = scan.integer("the dimension of a group");
    const long long number = scan.integer("the number of a group");
    const std::string_view line = scan.line();
    const auto begin = line.find('"'), end = line.rfind('"');
    if (begin == std::string_view::npos || begin == end) scan.fail("expected a name in quotes");
    if (dimension != 2 && dimension != 3) continue;
    auto& names = dimension == 2 ? data.surface_names : data.region_names;
    names[static_cast<int>(number)] = line.substr(begin + 1, end - begin - 1);
  }
}

/// The rows of a table in the order of tags; empty when one has no row.
Matrix arranged(const Table& table, const std::vector<long long>& tags) {
  Matrix out(table.components, static_cast<Eigen::Index>(tags.size()));
  for (Eigen::Index i = 0; i < out.cols(); ++i) {
    const auto row = table.rows.find(tags[i]);
    if (row == table.rows.end()) return {};
    out.col(i) = row->second;
  }
  return out;
}

void keep(const Table& table, const std::vector<long long>& tags, const char* what,
          std::map<std::string, Matrix>& fields, std::vector<std::string>& notes) {
  Matrix values = arranged(table, tags);
  if (values.size() > 0)
    fields[table.name] = std::move(values);
  else
    notes.push_back("field \"" + table.name + "\" left out: it does not cover all " + what);
}

Matrix row(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::RowVectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

bool any(const std::vector<double>& values) {
  return std::ranges::any_of(values, [](double v) { return v != 0; });
}

}  // namespace

MeshData read_gmsh(const std::filesystem::path& file) {
  Stream in(file);
  MeshData data;
  data.source = file;
  Content content;
  EntityGroups groups;
  std::vector<Table> of_nodes, of_elements;
  while (!in.scan.at_end()) {
    const std::string section(in.scan.word("a section"));
    if (!section.starts_with('$'))
      in.scan.fail("found \"" + section.substr(0, 30) + "\", expected a section ($Nodes, $Elements, …)");
    const std::string end = "$End" + section.substr(1);
    const bool four = in.version > 4;
    if (four && in.binary && section != "$PhysicalNames" && !section.ends_with("Data")) in.scan.line();
    if (section == "$PhysicalNames") {
      read_names(in.scan, data);
    } else if (section == "$Entities" && four) {
      groups = read_entities_4(in);
    } else if (section == "$Nodes") {
      four ? read_nodes_4(in, content) : read_nodes_2(in, content);
    } else if (section == "$Elements") {
      four ? read_elements_4(in, content, groups) : read_elements_2(in, content);
    } else if (section == "$NodeData") {
      of_nodes.push_back(read_table(in));
    } else if (section == "$ElementData") {
      of_elements.push_back(read_table(in));
    } else {
      in.scan.up_to(end);
      continue;
    }
    in.expect(end);
  }
  if (content.coordinates.empty()) in.scan.fail("found no $Nodes, expected a mesh");
  data.points = Eigen::Map<Points>(content.coordinates.data(), 3,
                                   static_cast<Eigen::Index>(content.coordinates.size() / 3));
  data.tets = content.tets.matrix();
  data.triangles = content.triangles.matrix();
  note_quadratic(data, content.quadratic_tets);
  if (any(content.regions)) data.tet_fields["region"] = row(content.regions);
  if (any(content.physical)) data.triangle_fields["physical"] = row(content.physical);
  if (any(content.geometrical)) data.triangle_fields["geometrical"] = row(content.geometrical);
  std::vector<long long> node_tags(content.point_of_tag.size());
  for (const auto& [tag, point] : content.point_of_tag) node_tags[point] = tag;
  for (const Table& table : of_nodes) keep(table, node_tags, "points", data.point_fields, data.notes);
  for (const Table& table : of_elements)
    keep(table, content.tet_tags, "tetrahedra", data.tet_fields, data.notes);
  return data;
}

}  // namespace polyaffine
