#include "polyaffine/mesh_io/vtu.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include <polyaffine/mesh_io/vtk_xml.hpp>

namespace polyaffine {
namespace {

using vtk_xml::Attributes;
using vtk_xml::DataArray;
using vtk_xml::Document;

// Numbers of VTK's cell types.
enum CellType {
  kVertex = 1,
  kPolyVertex = 2,
  kLine = 3,
  kPolyLine = 4,
  kTriangle = 5,
  kTet = 10,
  kQuadraticEdge = 21,
  kQuadraticTriangle = 22,
  kQuadraticTet = 24
};

std::size_t whole(Document& document, const std::string& text, const char* what) {
  std::size_t out = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
  if (error != std::errc() || end != text.data() + text.size() || out > std::numeric_limits<int>::max() / 4)
    document.fail(0, std::string("found ") + what + "=\"" + text.substr(0, 30) + "\", expected a number");
  return out;
}

// In words, with its number; for messages.
std::string cell_name(int type) {
  constexpr std::array<const char*, 15> kNames{
      "",      "vertex",        "vertices",    "line",  "polyline",   "triangle", "strip",  "polygon",
      "pixel", "quadrilateral", "tetrahedron", "voxel", "hexahedron", "wedge",    "pyramid"};
  const std::string number = "VTK's cell type " + (type < 0 ? "outside 0 to 255" : std::to_string(type));
  if (type <= 0 || type >= static_cast<int>(kNames.size())) return number;
  return number + " (" + kNames[static_cast<std::size_t>(type)] + ")";
}

/// The numbers in the piece of the cells of each kind.
struct CellNumbers {
  std::vector<std::size_t> tets, triangles;
};

// Corners from the points of a cell, which are numbers from 0.
std::vector<int> corners(Document& document, std::span<const double> of, const std::string& cell,
                         std::size_t wanted, Eigen::Index points) {
  if (of.size() < wanted)
    document.fail(
        0, cell + "found " + std::to_string(of.size()) + " points, expected " + std::to_string(wanted));
  std::vector<int> out;
  for (const double p : of) {
    if (!(p >= 0 && p < static_cast<double>(points) && p == std::floor(p)))
      document.fail(
          0, cell + "found the point " + std::to_string(p) + ", expected 0 to " + std::to_string(points - 1));
    out.push_back(static_cast<int>(p));
  }
  return out;
}

CellNumbers read_cells(Document& document, int piece, std::size_t count, MeshData& data,
                       std::size_t& quadratic_tets) {
  const auto types = values(document, document.array(piece, "Cells", "types"), count);
  const auto ends = values(document, document.array(piece, "Cells", "offsets"), count);
  double begin = 0;
  for (const double end : ends) {
    if (!(end >= begin && end < std::numeric_limits<int>::max() && end == std::floor(end)))
      document.fail(document.array(piece, "Cells", "offsets").position,
                    "found an offset " + std::to_string(end) + ", expected whole numbers that grow");
    begin = end;
  }
  const auto points = values(document, document.array(piece, "Cells", "connectivity"),
                             static_cast<std::size_t>(ends.empty() ? 0 : ends.back()));
  CellNumbers numbers;
  CellList tets{4}, triangles{3};
  std::size_t from = 0;
  for (std::size_t c = 0; c < count; ++c) {
    const int type = types[c] >= 0 && types[c] < 256 ? static_cast<int>(types[c]) : -1;  // a byte in VTK
    const auto to = static_cast<std::size_t>(ends[c]);
    const std::span<const double> of(points.data() + from, to - from);
    from = to;
    if (type == kVertex || type == kPolyVertex || type == kLine || type == kPolyLine ||
        type == kQuadraticEdge)
      continue;
    const auto cell = "cell " + std::to_string(c) + " (counted from 0): ";
    const bool tet = type == kTet || type == kQuadraticTet;
    if (!tet && type != kTriangle && type != kQuadraticTriangle)
      document.fail(0, cell + "found " + cell_name(type) +
                           ", expected 10 (tetrahedron) or 5 (triangle), or 24 or 22 (quadratic)");
    (tet ? tets : triangles).add(corners(document, of, cell, tet ? 4 : 3, data.points.cols()));
    (tet ? numbers.tets : numbers.triangles).push_back(c);
    quadratic_tets += type == kQuadraticTet;
  }
  data.tets = tets.matrix();
  data.triangles = triangles.matrix();
  return numbers;
}

Matrix table(Document& document, const DataArray& array, std::size_t tuples) {
  const std::size_t components =
      whole(document, array.attribute("NumberOfComponents", "1"), "NumberOfComponents");
  const auto all = values(document, array, components * tuples);
  return Eigen::Map<const Matrix>(all.data(), static_cast<Eigen::Index>(components),
                                  static_cast<Eigen::Index>(tuples));
}

Matrix chosen(const Matrix& of, const std::vector<std::size_t>& columns) {
  Matrix out(of.rows(), columns.size());
  for (std::size_t k = 0; k < columns.size(); ++k)
    out.col(static_cast<Eigen::Index>(k)) = of.col(static_cast<Eigen::Index>(columns[k]));
  return out;
}

MeshData read_piece(Document& document, int piece, std::size_t& quadratic_tets) {
  const Attributes& of = document.pieces[static_cast<std::size_t>(piece)];
  const auto count = [&](const char* name) {
    const auto found = of.find(name);
    return whole(document, found == of.end() ? "" : found->second, name);
  };
  const std::size_t points = count("NumberOfPoints"), cells = count("NumberOfCells");
  MeshData data;
  if (points == 0) return data;
  const DataArray& coordinates = document.array(piece, "Points", "");
  if (coordinates.attribute("NumberOfComponents") != "3")
    document.fail(coordinates.position, "found points without three coordinates");
  data.points = table(document, coordinates, points);
  const CellNumbers numbers = read_cells(document, piece, cells, data, quadratic_tets);
  for (const DataArray& array : document.arrays) {
    const std::string name = array.attribute("Name");
    if (array.piece != piece || name.empty() || !has_numbers(array)) continue;
    if (array.section == "PointData") data.point_fields[name] = table(document, array, points);
    if (array.section != "CellData") continue;
    const Matrix all = table(document, array, cells);
    data.tet_fields[name] = chosen(all, numbers.tets);
    data.triangle_fields[name] = chosen(all, numbers.triangles);
  }
  return data;
}

template <class Columns>
void append_columns(const Columns& more, Columns& to) {
  const Eigen::Index before = to.cols();
  to.conservativeResize(more.rows(), before + more.cols());
  to.rightCols(more.cols()) = more;
}

// Puts a piece behind the former ones; all have the same fields.
void append_piece(Document& document, const MeshData& piece, MeshData& data) {
  const auto before = static_cast<int>(data.points.cols());
  append_columns(piece.points, data.points);
  append_columns(Tets(piece.tets.array() + before), data.tets);
  append_columns(Triangles(piece.triangles.array() + before), data.triangles);
  for (auto fields : {&MeshData::point_fields, &MeshData::tet_fields, &MeshData::triangle_fields}) {
    if ((data.*fields).size() != (piece.*fields).size())
      document.fail(0, "found pieces with different arrays, expected the same in all");
    for (auto& [name, values] : data.*fields) {
      const auto more = (piece.*fields).find(name);
      if (more == (piece.*fields).end() || more->second.rows() != values.rows())
        document.fail(0, "found pieces with different arrays \"" + name + "\", expected the same in all");
      append_columns(more->second, values);
    }
  }
}

}  // namespace

MeshData read_vtu_data(const std::filesystem::path& file) {
  Document document(file);
  MeshData data;
  std::size_t quadratic_tets = 0;
  for (std::size_t p = 0; p < document.pieces.size(); ++p) {
    MeshData piece = read_piece(document, static_cast<int>(p), quadratic_tets);
    if (piece.points.cols() == 0) continue;  // of a processor that had nothing to write
    if (data.points.cols() == 0)
      data = std::move(piece);
    else
      append_piece(document, piece, data);
  }
  data.source = file;
  if (data.points.cols() == 0 || data.tets.cols() + data.triangles.cols() == 0)
    document.fail(0, "found no points or no cells, expected a mesh (unstructured grid)");
  note_quadratic(data, quadratic_tets);
  return data;
}

}  // namespace polyaffine
