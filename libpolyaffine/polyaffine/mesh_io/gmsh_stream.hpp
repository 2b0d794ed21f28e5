#pragma once

#include <array>
#include <unordered_map>

#include <polyaffine/mesh_io/file_scanner.hpp>
#include <polyaffine/mesh_io/mesh_data.hpp>

/// The parts of the Gmsh reader; for the sources of this folder only.
namespace polyaffine::gmsh {

/// Numbers of a .msh file, which are words or raw bytes.
class Stream {
 public:
  explicit Stream(const std::filesystem::path& file);  ///< reads $MeshFormat

  FileScanner scan;
  double version = 0;
  bool binary = false;

  long long integer(const char* expected);  ///< an int
  long long size(const char* expected);     ///< a size_t (version 4)
  double real(const char* expected);
  std::size_t count(long long found, const char* expected, std::size_t words) const;
  void expect(std::string_view word);

 private:
  int size_bytes_ = 8;
};

/// What the sections of a file give, by the file's own numbers.
struct Content {
  std::unordered_map<long long, int> point_of_tag;
  std::vector<double> coordinates;
  CellList tets{4}, triangles{3};
  std::vector<long long> tet_tags, triangle_tags;
  std::vector<double> regions, physical, geometrical;  ///< of tets, triangles, triangles
  std::size_t quadratic_tets = 0;

  void add_point(Stream& in, long long tag, const Vec3& x);
  int point(Stream& in, long long tag) const;
};

/// Number of points of an element type. Fails, naming it, when it is neither tetrahedron, triangle, line nor
/// point.
int element_points(Stream& in, long long type);
/// Adds one element; `points` are its tags in the file.
void add_element(Stream& in, Content& content, long long type, long long tag,
                 const std::vector<long long>& points, double physical, double geometrical);

void read_nodes_2(Stream& in, Content& content);
void read_elements_2(Stream& in, Content& content);

/// Physical group of each entity, by dimension and tag.
using EntityGroups = std::array<std::unordered_map<long long, long long>, 4>;
EntityGroups read_entities_4(Stream& in);
void read_nodes_4(Stream& in, Content& content);
void read_elements_4(Stream& in, Content& content, const EntityGroups& groups);

/// Rows of $NodeData or $ElementData.
struct Table {
  std::string name;
  int components = 0;
  std::unordered_map<long long, Vector> rows;
};
Table read_table(Stream& in);

}  // namespace polyaffine::gmsh
