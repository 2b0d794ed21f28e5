#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <polyaffine/core/types.hpp>

namespace polyaffine {

/// What a mesh file holds, valid or not. Lengths are in the unit of the file; indices are in range.
struct MeshData {
  std::filesystem::path source;
  Points points;
  Tets tets;                                      ///< corners, of quadratic ones too
  Triangles triangles;                            ///< corners, of quadratic ones too
  std::map<std::string, Matrix> point_fields;     ///< components × points
  std::map<std::string, Matrix> tet_fields;       ///< components × tets
  std::map<std::string, Matrix> triangle_fields;  ///< components × triangles
  std::map<int, std::string> surface_names;       ///< of numbers in the triangle field "physical"
  std::map<int, std::string> region_names;        ///< of numbers in the tet field "region"
  std::vector<std::string> notes;                 ///< what of the file was left out or reduced
};

/// Cells of one kind with their corner points, in a row: what a reader gathers.
struct CellList {
  int corners;
  std::vector<int> points{};

  /// Adds the corners of a cell.
  template <class Range>
  void add(const Range& cell) {
    points.insert(points.end(), cell.begin(), cell.begin() + corners);
  }
  Eigen::Index size() const { return static_cast<Eigen::Index>(points.size()) / corners; }
  Eigen::Map<const Eigen::MatrixXi> matrix() const { return {points.data(), corners, size()}; }
};

/// "quadratic tetrahedra: …" where there are any of them.
void note_quadratic(MeshData& data, std::size_t quadratic_tets);

}  // namespace polyaffine
