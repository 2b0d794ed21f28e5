#include <polyaffine/mesh_io/gmsh_stream.hpp>

namespace polyaffine::gmsh {

void read_nodes_2(Stream& in, Content& content) {
  const std::size_t count = in.scan.count("the number of nodes", 8);
  if (in.binary) in.scan.line();
  for (std::size_t i = 0; i < count; ++i) {
    const long long tag = in.integer("the number of a node");
    Vec3 x;
    for (double& coordinate : x) coordinate = in.real("a coordinate");
    content.add_point(in, tag, x);
  }
}

void read_elements_2(Stream& in, Content& content) {
  const std::size_t count = in.scan.count("the number of elements", 4);
  if (in.binary) in.scan.line();
  std::vector<long long> points, tags;
  for (std::size_t done = 0; done < count;) {
    // Text: number, type, tags and points of one element. Binary: blocks of one type with one header.
    long long tag = in.binary ? 0 : in.integer("the number of an element");
    const long long type = in.integer("the type of an element");
    const std::size_t block =
        in.binary ? in.count(in.integer("the size of a block"), "a size of a block", 1) : 1;
    tags.resize(in.count(in.integer("the number of tags"), "a number of tags", 1));
    points.resize(element_points(in, type));
    if (block == 0) in.scan.fail("found a block without elements, expected at least one");
    for (std::size_t i = 0; i < block; ++i, ++done) {
      if (in.binary) tag = in.integer("the number of an element");
      for (long long& t : tags) t = in.integer("a tag");
      for (long long& p : points) p = in.integer("a node of an element");
      add_element(in, content, type, tag, points, tags.empty() ? 0 : static_cast<double>(tags[0]),
                  tags.size() < 2 ? 0 : static_cast<double>(tags[1]));
    }
  }
}

}  // namespace polyaffine::gmsh
