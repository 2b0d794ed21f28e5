#pragma once

#include <utility>
#include <vector>

#include <polyaffine/core/archive_access.hpp>

namespace polyaffine {

/// Once continuously differentiable cubic through (x_k, y_k), x ascending, without overshoot between the
/// points (Fritsch & Carlson 1980 with the three-point slopes of Fritsch & Butland 1984); straight beyond the
/// ends.
class MonotoneCubic {
 public:
  MonotoneCubic() = default;
  /// Throws std::invalid_argument with fewer than two points or x not ascending.
  MonotoneCubic(std::vector<double> x, std::vector<double> y);
  /// Value and slope.
  std::pair<double, double> operator()(double x) const;

 private:
  friend class ArchiveAccess;
  template <class Archive>
  void archive(Archive& a) {
    a(x_, y_, slope_);
    if constexpr (Archive::kReading)
      if (!is_whole()) a.refuse("found a cubic without two points at least, x ascending");
  }
  bool is_whole() const;

  std::vector<double> x_, y_, slope_;
};

}  // namespace polyaffine
