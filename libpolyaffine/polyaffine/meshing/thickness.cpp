#include "polyaffine/meshing/thickness.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <variant>
#include <vector>

#include <polyaffine/mesh/surface.hpp>

namespace polyaffine {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Soup = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Soup::const_iterator>;

// Share of the surface that a thin place must have.
constexpr double kShare = 0.01;

}  // namespace

Vector thickness_behind(const Points& points, const Triangles& triangles) {
  const auto point = [](const Vec3& x) { return Kernel::Point_3(x[0], x[1], x[2]); };
  Soup soup;
  for (const auto& t : triangles.colwise())
    soup.emplace_back(point(points.col(t[0])), point(points.col(t[1])), point(points.col(t[2])));
  const CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree(soup.cbegin(), soup.cend());
  Vector out(triangles.cols());
  for (Eigen::Index f = 0; f < triangles.cols(); ++f) {
    const Mat3 x = points(Eigen::all, triangles.col(f));
    const Vec3 centre = x.rowwise().mean();
    const Vec3 inward = (x.col(2) - x.col(0)).cross(x.col(1) - x.col(0)).normalized();
    const auto own = soup.cbegin() + f;
    const Kernel::Ray_3 ray(point(centre), Kernel::Vector_3(inward[0], inward[1], inward[2]));
    const auto hit = tree.first_intersection(ray, [&](const auto& primitive) { return primitive == own; });
    out[f] = std::numeric_limits<double>::infinity();
    if (!hit) continue;
    if (const auto* at = boost::get<Kernel::Point_3>(&hit->first))
      out[f] = (Vec3(at->x(), at->y(), at->z()) - centre).norm();
  }
  return out;
}

ThinPlace thinnest_place(const Points& points, const Triangles& triangles) {
  const Vector thickness = thickness_behind(points, triangles), area = triangle_areas(points, triangles);
  std::vector<int> order(triangles.cols());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](int f) { return thickness[f]; });
  double passed = 0;
  const auto at = std::ranges::find_if(order, [&](int f) {
    passed += area[f];
    return passed > kShare * area.sum();
  });
  return {thickness[*at], points(Eigen::all, triangles.col(*at)).rowwise().mean()};
}

}  // namespace polyaffine
