#pragma once

#include <array>
#include <vector>

#include <polyaffine/geometry/locate.hpp>
#include <polyaffine/kinematics/lagrange.hpp>

namespace polyaffine {

/// Finds the curved elements that hold points: a grid of bounding boxes leads to few candidates, in each of
/// which the element map X(λ) is inverted by Newton's method. (Straight elements would be wrong by their
/// sagitta h²/8R.) The elements must outlive it.
class ElementLocator {
 public:
  explicit ElementLocator(const LagrangeBasis& elements);

  /// The element that holds x (mm) and its barycentric coordinates there. When none does, that of the nearest
  /// element continued beyond its faces, so that some coordinates are negative, with the distance from x to
  /// the element (coordinates cut off at zero). Throws InputError when x is not finite, ComputationError when
  /// no element's map reaches x.
  MeshPoint locate(const Vec3& x) const;

 private:
  struct Box {
    Vec3 low, high;
  };
  MeshPoint invert(int element, const Vec3& x) const;
  MeshPoint nearest(const Vec3& x, const int* first, const int* last) const;
  int cell(const Eigen::Vector3i& at) const { return at[0] + count_[0] * (at[1] + count_[1] * at[2]); }
  Eigen::Vector3i place(const Vec3& x) const;

  const LagrangeBasis& elements_;
  std::vector<Box> boxes_;
  Vec3 low_;
  double size_;
  Eigen::Vector3i count_;
  std::vector<int> start_, held_;  // elements of each cell
  std::vector<int> all_;
};

}  // namespace polyaffine
