#include "polyaffine/geometry/point_grid.hpp"

#include <cmath>

namespace polyaffine {

std::size_t PointGrid::Hash::operator()(const Cell& cell) const {
  std::uint64_t h = 0;
  for (const std::int64_t i : cell) {
    h = (h ^ static_cast<std::uint64_t>(i)) * 0x9e3779b97f4a7c15U;
    h ^= h >> 29;
  }
  return h;
}

PointGrid::PointGrid(double tolerance) : tolerance_(tolerance) {}

int PointGrid::find(const Vec3& x) const {
  const Vec3 low = (x.array() - tolerance_) / (2 * tolerance_);
  const Vec3 high = (x.array() + tolerance_) / (2 * tolerance_);
  Cell from, to, cell;
  for (int i = 0; i < 3; ++i) {
    from[i] = static_cast<std::int64_t>(std::floor(low[i]));
    to[i] = static_cast<std::int64_t>(std::floor(high[i]));
  }
  int best = -1;
  double nearest = tolerance_;
  for (cell[0] = from[0]; cell[0] <= to[0]; ++cell[0])
    for (cell[1] = from[1]; cell[1] <= to[1]; ++cell[1])
      for (cell[2] = from[2]; cell[2] <= to[2]; ++cell[2]) {
        const auto at = first_.find(cell);
        if (at == first_.end()) continue;
        for (int e = at->second; e >= 0; e = entries_[e].next) {
          const double distance = (entries_[e].x - x).norm();
          if (distance > nearest || (distance == nearest && best >= 0)) continue;
          nearest = distance;
          best = entries_[e].number;
        }
      }
  return best;
}

void PointGrid::add(const Vec3& x, int number) {
  Cell cell;
  for (int i = 0; i < 3; ++i) cell[i] = static_cast<std::int64_t>(std::floor(x[i] / (2 * tolerance_)));
  const auto [at, added] = first_.try_emplace(cell, -1);
  entries_.push_back({x, number, at->second});
  at->second = static_cast<int>(entries_.size()) - 1;
}

}  // namespace polyaffine
