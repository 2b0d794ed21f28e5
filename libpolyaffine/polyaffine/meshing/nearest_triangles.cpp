#include "polyaffine/meshing/nearest_triangles.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

namespace polyaffine {

std::vector<int> nearest_triangles(const Points& points, const Triangles& triangles, const Points& places) {
  using Kernel = CGAL::Simple_cartesian<double>;
  using Soup = std::vector<Kernel::Triangle_3>;
  using Primitive = CGAL::AABB_triangle_primitive<Kernel, Soup::const_iterator>;
  const auto point = [](const auto& x) { return Kernel::Point_3(x[0], x[1], x[2]); };
  Soup soup;
  for (const auto& t : triangles.colwise())
    soup.emplace_back(point(points.col(t[0])), point(points.col(t[1])), point(points.col(t[2])));
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree(soup.cbegin(), soup.cend());
  std::vector<int> out;
  for (const auto& x : places.colwise())
    out.push_back(static_cast<int>(tree.closest_point_and_primitive(point(x)).second - soup.cbegin()));
  return out;
}

}  // namespace polyaffine
