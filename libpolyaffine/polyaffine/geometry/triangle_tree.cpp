#include "polyaffine/geometry/triangle_tree.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace polyaffine {
namespace {

// Most triangles of a leaf: testing this many costs about as much as two more boxes.
constexpr int kLeaf = 4;
// Boxes that wait to be visited: one a level, and halving leaves fewer than 64 levels for any number of
// triangles that fits an int.
constexpr int kLevels = 64;

Vec3 centre(const Points& points, const Eigen::Vector3i& triangle) {
  return points(Eigen::all, triangle).rowwise().mean();
}

// Solves origin + s direction = a + u (b − a) + v (c − a) by Cramer's rule; `triangle` holds a, b − a, c − a.
bool meets(const Mat3& triangle, const Vec3& origin, const Vec3& direction, double from) {
  const Vec3 p = direction.cross(triangle.col(2));
  const double det = triangle.col(1).dot(p);
  if (det == 0) return false;
  const Vec3 to_origin = origin - triangle.col(0);
  const double u = to_origin.dot(p) / det;
  if (!(u >= 0 && u <= 1)) return false;
  const Vec3 q = to_origin.cross(triangle.col(1));
  const double v = direction.dot(q) / det;
  return v >= 0 && u + v <= 1 && triangle.col(2).dot(q) / det > from;
}

}  // namespace

TriangleTree::TriangleTree(const Points& points, const Triangles& triangles) {
  std::vector<int> order(triangles.cols());
  std::iota(order.begin(), order.end(), 0);
  build(points, triangles, order, 0, static_cast<int>(order.size()));
  for (const int t : order) {
    Mat3& c = corners_.emplace_back(points(Eigen::all, triangles.col(t)));
    c.rightCols(2).colwise() -= Vec3(c.col(0));
  }
}

int TriangleTree::build(const Points& points, const Triangles& triangles, std::vector<int>& order, int first,
                        int last) {
  const int box = static_cast<int>(boxes_.size());
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  boxes_.push_back({Vec3::Constant(kInfinity), Vec3::Constant(-kInfinity), first, last});
  for (int i = first; i < last; ++i)
    for (const int v : triangles.col(order[i])) {
      boxes_[box].low = boxes_[box].low.cwiseMin(points.col(v));
      boxes_[box].high = boxes_[box].high.cwiseMax(points.col(v));
    }
  if (last - first <= kLeaf) return box;
  int axis = 0;
  (boxes_[box].high - boxes_[box].low).maxCoeff(&axis);
  const int middle = (first + last) / 2;
  std::nth_element(order.begin() + first, order.begin() + middle, order.begin() + last, [&](int a, int b) {
    return centre(points, triangles.col(a))[axis] < centre(points, triangles.col(b))[axis];
  });
  build(points, triangles, order, first, middle);
  const int second = build(points, triangles, order, middle, last);
  boxes_[box].first = -1;
  boxes_[box].last = second;
  return box;
}

bool TriangleTree::hit(const Vec3& origin, const Vec3& direction, double from) const {
  const Vec3 inverse = direction.cwiseInverse();  // infinite along an axis, which the slabs below allow for
  std::array<int, kLevels> stack;
  int size = 0;
  if (!boxes_.empty()) stack[size++] = 0;
  while (size > 0) {
    const int b = stack[--size];
    const Box& box = boxes_[b];
    // The ray is inside a box where it is between all three pairs of its planes.
    const Vec3 one = (box.low - origin).cwiseProduct(inverse),
               other = (box.high - origin).cwiseProduct(inverse);
    const double enter = one.cwiseMin(other).maxCoeff(), leave = one.cwiseMax(other).minCoeff();
    if (enter > leave || leave < from) continue;
    if (box.first < 0) {
      stack[size++] = b + 1;
      stack[size++] = box.last;
      continue;
    }
    for (int i = box.first; i < box.last; ++i)
      if (meets(corners_[i], origin, direction, from)) return true;
  }
  return false;
}

}  // namespace polyaffine
