#pragma once

#include <vector>

#include <polyaffine/core/types.hpp>

namespace polyaffine {

/// A function whose vector coefficient does not move in one direction, n·c_a = 0: a point that slides in a
/// plane. The other two directions are free. Directions are unit vectors in the axes of the coefficients.
struct HeldDirection {
  int function = 0;
  Vec3 direction = Vec3::UnitZ();

  /// The part of a coefficient or of its force that is free, P = I − n nᵀ.
  Mat3 free() const { return Mat3::Identity() - direction * direction.transpose(); }
};
using HeldDirections = std::vector<HeldDirection>;

}  // namespace polyaffine
