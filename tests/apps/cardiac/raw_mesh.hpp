#pragma once

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <polyaffine/mesh/tet_mesh.hpp>
#include <polyaffine/vtk/read.hpp>

/// The coarse mesh of Land's ellipsoid.
inline const polyaffine::TetMesh& land_mesh() {
  static const auto mesh = polyaffine::read_vtu(PROJECT_DIR "/meshes/land_ellipsoid_coarse.vtu", 1);
  return mesh;
}

/// A mesh as a file holds it, valid or not.
struct RawMesh {
  struct Cell {
    int vtk_type;
    std::vector<int> points;
    int label;
  };
  std::vector<polyaffine::Vec3> points;
  std::vector<Cell> cells;
};

inline constexpr int kVtkTriangle = 5, kVtkTetra = 10, kVtkHexahedron = 12;

inline RawMesh raw(const polyaffine::TetMesh& mesh) {
  RawMesh out;
  for (const auto& x : mesh.points().colwise()) out.points.emplace_back(x);
  for (const auto& t : mesh.tets().colwise()) out.cells.push_back({kVtkTetra, {t.begin(), t.end()}, 0});
  for (Eigen::Index f = 0; f < mesh.boundary().cols(); ++f) {
    const auto t = mesh.boundary().col(f);
    out.cells.push_back({kVtkTriangle, {t.begin(), t.end()}, mesh.boundary_labels()[f]});
  }
  return out;
}

/// Writes a .vtu file by hand: text, but for the coordinates, which are raw binary and so may be NaN.
inline void write_raw(const std::filesystem::path& file, const RawMesh& mesh) {
  std::string connectivity, offsets, types, labels;
  std::size_t offset = 0;
  for (const auto& cell : mesh.cells) {
    for (const int p : cell.points) connectivity += std::to_string(p) + ' ';
    offsets += std::to_string(offset += cell.points.size()) + ' ';
    types += std::to_string(cell.vtk_type) + ' ';
    labels += std::to_string(cell.label) + ' ';
  }
  const auto array = [](const char* type, const char* name, const std::string& text) {
    return std::string("<DataArray type=\"") + type + "\" Name=\"" + name + "\" format=\"ascii\">" + text +
           "</DataArray>\n";
  };
  std::ofstream out(file, std::ios::binary);
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
         "byte_order=\"LittleEndian\" header_type=\"UInt32\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\""
      << mesh.points.size() << "\" NumberOfCells=\"" << mesh.cells.size()
      << "\">\n<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"appended\" "
         "offset=\"0\"/></Points>\n<Cells>\n"
      << array("Int64", "connectivity", connectivity) << array("Int64", "offsets", offsets)
      << array("UInt8", "types", types) << "</Cells>\n<CellData>\n"
      << array("Int32", "surface", labels)
      << "</CellData>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">_";
  const auto bytes = static_cast<std::uint32_t>(24 * mesh.points.size());
  out.write(reinterpret_cast<const char*>(&bytes), sizeof bytes);
  for (const auto& x : mesh.points) out.write(reinterpret_cast<const char*>(x.data()), 24);
  out << "</AppendedData>\n</VTKFile>\n";
}

/// The nine tets between two cones of three sides each, open at the top: fewer tets than segments.
inline RawMesh nine_tets() {
  const double s = std::sqrt(3.0) / 2;
  const std::array<polyaffine::Vec3, 3> corner{{{0, 1, 0}, {-s, -0.5, 0}, {s, -0.5, 0}}};
  const polyaffine::Vec3 up(0, 0, 20);
  RawMesh out;
  for (const double radius : {10.0, 16.0})  // 0 to 2 endocardium, 3 to 5 epicardium
    for (const auto& c : corner) out.points.push_back(radius * c + up);
  out.points.emplace_back(0, 0, 0);    // 6: the apex of the cavity
  out.points.emplace_back(0, 0, -12);  // 7: of the wall
  for (const auto& [low, high] : {std::pair{0, 1}, {1, 2}, {0, 2}}) {
    // The prism from (low, high, 6) to (low + 3, high + 3, 7).
    std::vector<std::vector<int>> tets{
        {low, high, 6, 7}, {low, high, high + 3, 7}, {low, low + 3, high + 3, 7}};
    for (auto& t : tets) {
      polyaffine::Mat3 edges;
      for (int k = 0; k < 3; ++k) edges.col(k) = out.points[t[k + 1]] - out.points[t[0]];
      if (edges.determinant() < 0) std::swap(t[2], t[3]);
      out.cells.push_back({kVtkTetra, t, 0});
    }
    out.cells.push_back({kVtkTriangle, {low, high, 6}, 1});
    out.cells.push_back({kVtkTriangle, {low + 3, high + 3, 7}, 2});
    out.cells.push_back({kVtkTriangle, {low, high, high + 3}, 3});
    out.cells.push_back({kVtkTriangle, {low, low + 3, high + 3}, 3});
  }
  return out;
}
