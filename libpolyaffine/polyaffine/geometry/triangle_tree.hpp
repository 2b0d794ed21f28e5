#pragma once

#include <vector>

#include <polyaffine/core/types.hpp>

namespace polyaffine {

/// Triangles in a tree of boxes, for rays.
class TriangleTree {
 public:
  TriangleTree(const Points& points, const Triangles& triangles);

  /// Does the ray from `origin` along `direction` meet a triangle farther than `from` (in lengths of the
  /// direction)? (Möller, Trumbore 1997.)
  bool hit(const Vec3& origin, const Vec3& direction, double from) const;

 private:
  struct Box {
    Vec3 low, high;
    int first, last;  ///< triangles of a leaf, or −1 and the second child (the first one follows)
  };
  int build(const Points& points, const Triangles& triangles, std::vector<int>& order, int first, int last);

  std::vector<Box> boxes_;
  std::vector<Mat3> corners_;  ///< first corner and the two edges from it, in the order of the leaves
};

}  // namespace polyaffine
