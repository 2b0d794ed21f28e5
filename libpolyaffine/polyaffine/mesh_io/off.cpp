#include <string>

#include <polyaffine/mesh_io/file_scanner.hpp>
#include <polyaffine/mesh_io/surface_formats.hpp>

namespace polyaffine {

void add_polygon(CellList& triangles, const std::vector<int>& corners) {
  for (std::size_t k = 1; k + 1 < corners.size(); ++k)
    triangles.add(std::vector<int>{corners[0], corners[k], corners[k + 1]});
}

MeshData read_off(const std::filesystem::path& file) {
  FileScanner scan(file, '#');
  const std::string_view header = scan.word("OFF");
  if (!header.ends_with("OFF"))
    scan.fail("found \"" + std::string(header.substr(0, 30)) + "\", expected a file that begins with OFF");
  const std::size_t num_points = scan.count("the number of points", 6);
  const std::size_t num_faces = scan.count("the number of faces", 6);
  scan.integer("the number of edges");
  MeshData data;
  data.source = file;
  data.points.resize(3, static_cast<Eigen::Index>(num_points));
  for (auto x : data.points.colwise()) {
    for (double& coordinate : x) coordinate = scan.real("a coordinate");
    scan.line();
  }
  CellList triangles{3};
  for (std::size_t f = 0; f < num_faces; ++f) {
    std::vector<int> corners(scan.count("the number of corners of a face", 2));
    if (corners.size() < 3)
      scan.fail("found a face of " + std::to_string(corners.size()) + " points, expected at least 3");
    for (int& p : corners) p = scan.vertex(scan.integer("a point of a face"), 0, data.points.cols());
    scan.line();
    add_polygon(triangles, corners);
  }
  data.triangles = triangles.matrix();
  return data;
}

}  // namespace polyaffine
