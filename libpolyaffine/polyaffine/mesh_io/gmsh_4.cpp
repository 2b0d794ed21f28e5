#include <polyaffine/mesh_io/gmsh_stream.hpp>

namespace polyaffine::gmsh {

EntityGroups read_entities_4(Stream& in) {
  EntityGroups groups;
  std::array<std::size_t, 4> number{};
  for (std::size_t& n : number) n = in.count(in.size("a number of entities"), "a number of entities", 5);
  for (int dimension = 0; dimension < 4; ++dimension)
    for (std::size_t i = 0; i < number[dimension]; ++i) {
      const long long tag = in.integer("the number of an entity");
      for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) in.real("a bound of an entity");
      const std::size_t physical =
          in.count(in.size("the number of physical groups"), "a number of physical groups", 1);
      for (std::size_t k = 0; k < physical; ++k) {
        const long long group = in.integer("a physical group");
        if (k == 0) groups[dimension][tag] = group;
      }
      if (dimension == 0) continue;
      std::size_t bounds = in.count(in.size("the number of bounding entities"), "a number of entities", 1);
      for (; bounds > 0; --bounds) in.integer("a bounding entity");
    }
  return groups;
}

void read_nodes_4(Stream& in, Content& content) {
  const std::size_t blocks = in.count(in.size("the number of blocks"), "a number of blocks", 4);
  for (int i = 0; i < 3; ++i) in.size("number, smallest and largest tag of the nodes");
  std::vector<long long> tags;
  for (std::size_t b = 0; b < blocks; ++b) {
    const long long dimension = in.integer("the dimension of an entity");
    in.integer("the number of an entity");
    const bool parametric = in.integer("0 or 1") != 0;
    tags.resize(in.count(in.size("the number of nodes"), "a number of nodes", 4));
    for (long long& tag : tags) tag = in.size("the number of a node");
    for (const long long tag : tags) {
      Vec3 x;
      for (double& coordinate : x) coordinate = in.real("a coordinate");
      for (long long k = 0; parametric && k < dimension; ++k) in.real("a parametric coordinate");
      content.add_point(in, tag, x);
    }
  }
}

void read_elements_4(Stream& in, Content& content, const EntityGroups& groups) {
  const std::size_t blocks = in.count(in.size("the number of blocks"), "a number of blocks", 4);
  for (int i = 0; i < 3; ++i) in.size("number, smallest and largest tag of the elements");
  std::vector<long long> points;
  for (std::size_t b = 0; b < blocks; ++b) {
    const long long dimension = in.integer("the dimension of an entity");
    const long long entity = in.integer("the number of an entity");
    const long long type = in.integer("the type of elements");
    points.resize(element_points(in, type));
    const std::size_t count = in.count(in.size("the number of elements"), "a number of elements", 2);
    if (dimension < 0 || dimension > 3)
      in.scan.fail("found the dimension " + std::to_string(dimension) + ", expected 0 to 3");
    const auto group = groups[dimension].find(entity);
    const double physical = group == groups[dimension].end() ? 0 : static_cast<double>(group->second);
    for (std::size_t i = 0; i < count; ++i) {
      const long long tag = in.size("the number of an element");
      for (long long& p : points) p = in.size("a node of an element");
      add_element(in, content, type, tag, points, physical, static_cast<double>(entity));
    }
  }
}

}  // namespace polyaffine::gmsh
