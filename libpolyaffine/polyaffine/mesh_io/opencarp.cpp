#include "polyaffine/mesh_io/opencarp.hpp"

#include <algorithm>
#include <cctype>
#include <limits>
#include <map>
#include <string>

#include <polyaffine/mesh_io/file_extension.hpp>
#include <polyaffine/mesh_io/file_scanner.hpp>

namespace polyaffine {
namespace {

struct CellType {
  int points;
  const char* name;
};

const std::map<std::string, CellType, std::less<>>& cell_types() {
  static const std::map<std::string, CellType, std::less<>> types{
      {"Ln", {2, "line"}},  {"Tr", {3, "triangle"}},  {"Qd", {4, "quadrilateral"}},
      {"Tt", {4, "tet"}},   {"Py", {5, "pyramid"}},   {"Oc", {6, "octahedron"}},
      {"Pr", {6, "prism"}}, {"Hx", {8, "hexahedron"}}};
  return types;
}

Points read_points(const std::filesystem::path& file) {
  FileScanner scan(file);
  Points points(3, static_cast<Eigen::Index>(scan.count("the number of points", 6)));
  for (double& x : points.reshaped()) x = scan.real("a coordinate");
  return points;
}

/// For each cell of the file, in order: is it a tet?
std::vector<char> read_cells(const std::filesystem::path& file, MeshData& data) {
  FileScanner scan(file);
  const std::size_t count = scan.count("the number of cells", 6);
  CellList tets{4}, triangles{3};
  std::vector<double> tet_tags, triangle_tags;
  std::vector<char> is_tet;
  std::vector<int> corners;
  for (std::size_t c = 0; c < count; ++c) {
    const std::string_view word = scan.word("a cell (Tt and four points)");
    const auto type = cell_types().find(word);
    if (type == cell_types().end())
      scan.fail("found \"" + std::string(word.substr(0, 10)) + "\", expected a cell (Tt and four points)");
    if (word != "Tt" && word != "Tr" && word != "Ln")
      scan.fail("found a " + std::string(type->second.name) + " (" + std::string(word) +
                "), expected tetrahedra (Tt)");
    const bool tet = word == "Tt", triangle = word == "Tr";
    corners.clear();
    for (int k = 0; k < type->second.points; ++k)
      corners.push_back(scan.vertex(scan.integer("a point of the cell"), 0, data.points.cols()));
    const auto tag = static_cast<double>(scan.integer_in_line().value_or(0));
    is_tet.push_back(tet);
    if (tet) {
      tets.add(corners);
      tet_tags.push_back(tag);
    } else if (triangle) {
      triangles.add(corners);
      triangle_tags.push_back(tag);
    }
  }
  data.tets = tets.matrix();
  data.triangles = triangles.matrix();
  data.tet_fields["region"] = Eigen::Map<Eigen::RowVectorXd>(tet_tags.data(), tets.size());
  if (triangles.size() > 0)
    data.triangle_fields["tag"] = Eigen::Map<Eigen::RowVectorXd>(triangle_tags.data(), triangles.size());
  return is_tet;
}

void read_fibres(const std::filesystem::path& file, const std::vector<char>& is_tet, MeshData& data) {
  FileScanner scan(file);
  const long long axes = scan.integer("1 or 2, the number of vectors per cell");
  if (axes != 1 && axes != 2)
    scan.fail("found " + std::to_string(axes) + ", expected 1 or 2, the number of vectors per cell");
  Matrix all(3 * axes, data.tets.cols());
  Eigen::Index t = 0;
  for (const char tet : is_tet) {
    Vector vectors(3 * axes);
    for (double& v : vectors) v = scan.real("a component of a fibre vector, one line for each cell");
    if (tet) all.col(t++) = vectors;
  }
  data.tet_fields["fibre"] = all.topRows(3);
  if (axes == 2) data.tet_fields["sheet"] = all.bottomRows(3);
}

}  // namespace

MeshData read_opencarp(const std::filesystem::path& file) {
  // The companion of a file with the extension in capitals has it in capitals too.
  const bool capitals = file.extension() != lower_extension(file);
  const auto with = [&](std::string extension) {
    const auto small = std::filesystem::path(file).replace_extension(extension);
    if (!capitals || std::filesystem::exists(small)) return small;
    std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::toupper(c); });
    return std::filesystem::path(file).replace_extension(extension);
  };
  MeshData data;
  data.source = file;
  data.points = read_points(with(".pts"));
  const std::vector<char> is_tet = read_cells(with(".elem"), data);
  if (std::filesystem::exists(with(".lon"))) read_fibres(with(".lon"), is_tet, data);
  return data;
}

}  // namespace polyaffine
