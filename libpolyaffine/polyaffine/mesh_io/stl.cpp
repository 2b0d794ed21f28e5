#include <array>
#include <cstdint>
#include <string>

#include <polyaffine/mesh_io/file_scanner.hpp>
#include <polyaffine/mesh_io/surface_formats.hpp>

namespace polyaffine {
namespace {

constexpr std::size_t kHeader = 80, kTriangleBytes = 50;

/// The number of triangles of a binary file, as its header says; text files seldom give their own size.
std::size_t binary_count(FileScanner& scan) {
  if (scan.size() < kHeader + 4) return 0;
  std::uint32_t count = 0;
  std::memcpy(&count, scan.text().data() + kHeader, sizeof count);
  return count;
}

std::vector<double> read_binary(FileScanner& scan, std::size_t count) {
  scan.bytes(kHeader + 4, "the header");
  std::vector<double> coordinates;
  for (std::size_t t = 0; t < count; ++t) {
    std::array<float, 12> numbers;  // normal, then three corners
    std::memcpy(numbers.data(), scan.bytes(kTriangleBytes, "a triangle").data(), sizeof numbers);
    coordinates.insert(coordinates.end(), numbers.begin() + 3, numbers.end());
  }
  return coordinates;
}

std::vector<double> read_text(FileScanner& scan) {
  std::vector<double> coordinates;
  scan.line();
  bool ended = false;
  while (!scan.at_end()) {
    const std::string_view word = scan.word("endsolid");
    if (word == "vertex")
      for (int k = 0; k < 3; ++k) coordinates.push_back(scan.real("a coordinate"));
    else if (word == "facet")
      scan.line();  // its normal
    else if (word == "endsolid" || word == "solid") {
      ended = word == "endsolid";
      scan.line();
    } else if (word != "outer" && word != "loop" && word != "endloop" && word != "endfacet")
      scan.fail("found \"" + std::string(word.substr(0, 30)) + "\", expected facets of an STL file");
  }
  if (!ended) scan.fail("found the end of the file, expected endsolid (is the file cut off?)");
  if (coordinates.size() % 9 != 0)
    scan.fail("found " + std::to_string(coordinates.size() / 3) + " corners, expected three for each facet");
  return coordinates;
}

}  // namespace

MeshData read_stl(const std::filesystem::path& file) {
  FileScanner scan(file);
  const std::size_t count = binary_count(scan);
  const bool binary = scan.size() == kHeader + 4 + count * kTriangleBytes;
  const bool text = scan.text().starts_with("solid") && scan.text().find("facet") != std::string_view::npos;
  if (!binary && !text)
    scan.fail("found neither text (solid … facet …) nor a binary STL file: " + std::to_string(scan.size()) +
              " bytes, expected " + std::to_string(kHeader + 4 + count * kTriangleBytes) + " for " +
              std::to_string(count) + " triangles (is the file cut off?)");
  std::vector<double> coordinates = binary ? read_binary(scan, count) : read_text(scan);
  MeshData data;
  data.source = file;
  data.points = Eigen::Map<Points>(coordinates.data(), 3, static_cast<Eigen::Index>(coordinates.size() / 3));
  data.triangles.resize(3, data.points.cols() / 3);
  for (int i = 0; i < static_cast<int>(data.triangles.size()); ++i) data.triangles.data()[i] = i;
  return data;
}

}  // namespace polyaffine
