#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include <polyaffine/core/types.hpp>

namespace polyaffine {

/// Points that can be found again by their position within a tolerance (a hash of cubes of twice that size).
class PointGrid {
 public:
  explicit PointGrid(double tolerance);

  /// Nearest point added within the tolerance, −1 without one.
  int find(const Vec3& x) const;
  /// Adds a point under a number.
  void add(const Vec3& x, int number);

 private:
  using Cell = std::array<std::int64_t, 3>;
  struct Hash {
    std::size_t operator()(const Cell& cell) const;
  };
  struct Entry {
    Vec3 x;
    int number;
    int next;  ///< entry of the same cube, −1 at the end
  };

  double tolerance_;
  std::vector<Entry> entries_;
  std::unordered_map<Cell, int, Hash> first_;
};

}  // namespace polyaffine
