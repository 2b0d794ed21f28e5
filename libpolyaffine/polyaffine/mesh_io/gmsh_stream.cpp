#include "polyaffine/mesh_io/gmsh_stream.hpp"

#include <cstdint>
#include <map>
#include <string>

namespace polyaffine::gmsh {
namespace {

struct ElementType {
  const char* name;
  int points;
  int corners;  ///< that are kept: of tetrahedra and triangles; 0 for what is passed over, −1 for a refusal
};

const ElementType* element_type(long long type) {
  static const std::map<long long, ElementType> types{{1, {"line", 2, 0}},
                                                      {2, {"triangle", 3, 3}},
                                                      {3, {"quadrilateral", 4, -1}},
                                                      {4, {"tetrahedron", 4, 4}},
                                                      {5, {"hexahedron", 8, -1}},
                                                      {6, {"prism", 6, -1}},
                                                      {7, {"pyramid", 5, -1}},
                                                      {8, {"quadratic line", 3, 0}},
                                                      {9, {"quadratic triangle", 6, 3}},
                                                      {10, {"quadratic quadrilateral", 9, -1}},
                                                      {11, {"quadratic tetrahedron", 10, 4}},
                                                      {12, {"quadratic hexahedron", 27, -1}},
                                                      {13, {"quadratic prism", 18, -1}},
                                                      {14, {"quadratic pyramid", 14, -1}},
                                                      {15, {"point", 1, 0}},
                                                      {16, {"quadratic quadrilateral", 8, -1}},
                                                      {17, {"quadratic hexahedron", 20, -1}},
                                                      {18, {"quadratic prism", 15, -1}},
                                                      {19, {"quadratic pyramid", 13, -1}}};
  const auto found = types.find(type);
  return found == types.end() ? nullptr : &found->second;
}

}  // namespace

Stream::Stream(const std::filesystem::path& file) : scan(file) {
  if (scan.word("$MeshFormat") != "$MeshFormat")
    scan.fail("found no $MeshFormat, expected a Gmsh file of version 2.2 or 4.1");
  version = scan.real("the version of the format");
  if (version != 2.2 && version != 4.1)
    scan.fail("found the version " + std::to_string(version).substr(0, 3) +
              " of the format, expected 2.2 or 4.1 (Gmsh: Mesh.MshFileVersion)");
  binary = scan.integer("0 (text) or 1 (binary)") == 1;
  size_bytes_ = static_cast<int>(scan.integer("the size of numbers in bytes"));
  if (size_bytes_ != 8 && size_bytes_ != 4) scan.fail("expected numbers of 8 or 4 bytes");
  scan.line();
  if (binary && scan.binary<std::int32_t>("1") != 1)
    scan.fail("found another byte order than that of this processor, expected little endian");
  expect("$EndMeshFormat");
}

long long Stream::integer(const char* expected) {
  return binary ? scan.binary<std::int32_t>(expected) : scan.integer(expected);
}

long long Stream::size(const char* expected) {
  if (!binary) return scan.integer(expected);
  if (size_bytes_ == 4) return scan.binary<std::uint32_t>(expected);
  return static_cast<long long>(scan.binary<std::uint64_t>(expected));
}

double Stream::real(const char* expected) {
  return binary ? scan.binary<double>(expected) : scan.real(expected);
}

std::size_t Stream::count(long long found, const char* expected, std::size_t words) const {
  scan.check_count(found, expected, binary ? 4 * words : 2 * words);
  return static_cast<std::size_t>(found);
}

void Stream::expect(std::string_view word) {
  const std::string_view found = scan.word(word.data());
  if (found != word)
    scan.fail("found another number of entries than announced, expected " + std::string(word));
}

void Content::add_point(Stream& in, long long tag, const Vec3& x) {
  if (!point_of_tag.emplace(tag, static_cast<int>(coordinates.size() / 3)).second)
    in.scan.fail("found the node " + std::to_string(tag) + " twice, expected each number once");
  coordinates.insert(coordinates.end(), x.begin(), x.end());
}

int Content::point(Stream& in, long long tag) const {
  const auto found = point_of_tag.find(tag);
  if (found == point_of_tag.end())
    in.scan.fail("found the node " + std::to_string(tag) + " in an element, expected a number of $Nodes");
  return found->second;
}

int element_points(Stream& in, long long type) {
  const ElementType* known = element_type(type);
  if (known != nullptr && known->corners >= 0) return known->points;
  in.scan.fail("found the element type " + std::to_string(type) +
               (known == nullptr ? std::string() : " (" + std::string(known->name) + ")") +
               ", expected linear or quadratic tetrahedra and triangles (4, 11, 2, 9)");
}

void add_element(Stream& in, Content& content, long long type, long long tag,
                 const std::vector<long long>& points, double physical, double geometrical) {
  const int corners = element_type(type)->corners;
  std::array<int, 4> cell{};
  for (int k = 0; k < corners; ++k) cell[k] = content.point(in, points[k]);
  if (corners == 4) {
    content.tets.add(cell);
    content.tet_tags.push_back(tag);
    content.regions.push_back(physical);
    content.quadratic_tets += points.size() > 4;
  } else if (corners == 3) {
    content.triangles.add(cell);
    content.triangle_tags.push_back(tag);
    content.physical.push_back(physical);
    content.geometrical.push_back(geometrical);
  }
}

Table read_table(Stream& in) {
  FileScanner& scan = in.scan;
  Table table;
  const std::size_t names = scan.count("the number of texts", 1);
  scan.line();
  for (std::size_t i = 0; i < names; ++i) {
    const std::string_view line = scan.line();
    const auto begin = line.find('"'), end = line.rfind('"');
    if (i == 0) table.name = begin < end ? line.substr(begin + 1, end - begin - 1) : line;
  }
  for (std::size_t i = scan.count("the number of reals", 1); i > 0; --i) scan.real("a real tag");
  std::vector<long long> tags(scan.count("the number of integers", 1));
  for (long long& tag : tags) tag = scan.integer("an integer tag");
  if (tags.size() < 3 || (tags[1] != 1 && tags[1] != 3 && tags[1] != 9))
    scan.fail("expected time step, number of components (1, 3 or 9) and of rows");
  table.components = static_cast<int>(tags[1]);
  const std::size_t rows = in.count(tags[2], "the number of rows", 1 + table.components);
  scan.line();
  for (std::size_t i = 0; i < rows; ++i) {
    const long long tag = in.integer("a number of a node or element");
    Vector& row = table.rows[tag] = Vector(table.components);
    for (double& v : row) v = in.real("a value");
  }
  return table;
}

}  // namespace polyaffine::gmsh
