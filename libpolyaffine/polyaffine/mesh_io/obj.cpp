#include <charconv>
#include <string>

#include <polyaffine/mesh_io/file_scanner.hpp>
#include <polyaffine/mesh_io/surface_formats.hpp>

namespace polyaffine {
namespace {

/// Words of the rest of a line.
std::vector<std::string_view> words(std::string_view line) {
  line = line.substr(0, line.find('#'));
  std::vector<std::string_view> out;
  while (true) {
    const auto begin = line.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos) return out;
    const auto end = std::min(line.find_first_of(" \t\r", begin), line.size());
    out.push_back(line.substr(begin, end - begin));
    line.remove_prefix(end);
  }
}

}  // namespace

MeshData read_obj(const std::filesystem::path& file) {
  FileScanner scan(file, '#');
  std::vector<double> coordinates;
  CellList triangles{3};
  while (!scan.at_end()) {
    const std::string_view what = scan.word("v or f");
    if (what == "v")
      for (int k = 0; k < 3; ++k) coordinates.push_back(scan.real("a coordinate"));
    const std::string_view rest = scan.line();
    if (what != "f") continue;
    const auto num_points = static_cast<long long>(coordinates.size() / 3);
    std::vector<int> corners;
    for (const std::string_view word : words(rest)) {
      long long number = 0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
      if (error != std::errc() || (end != word.data() + word.size() && *end != '/'))
        scan.fail("found \"" + std::string(word.substr(0, 30)) + "\", expected a point of a face");
      corners.push_back(scan.vertex(number < 0 ? num_points + number + 1 : number, 1, num_points));
    }
    if (corners.size() < 3)
      scan.fail("found a face of " + std::to_string(corners.size()) + " points, expected at least 3");
    add_polygon(triangles, corners);
  }
  MeshData data;
  data.source = file;
  data.points = Eigen::Map<Points>(coordinates.data(), 3, static_cast<Eigen::Index>(coordinates.size() / 3));
  data.triangles = triangles.matrix();
  return data;
}

}  // namespace polyaffine
