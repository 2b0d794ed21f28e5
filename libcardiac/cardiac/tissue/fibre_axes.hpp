#pragma once

#include <Eigen/Core>

#include <polyaffine/material/batch.hpp>

namespace cardiac {

/// Local tissue axes, one column of nine numbers a point: fibre f, sheet s, sheet normal n, each a unit
/// vector in the axes of the reference configuration.
using FibreAxes = Eigen::Matrix<double, 9, Eigen::Dynamic>;

/// Throws polyaffine::InputError that names the first point whose axes are not orthonormal to 10⁻⁶.
void require_orthonormal(const FibreAxes& axes);

/// Axes laid out for packs of points: each of the nine numbers in a row of its own.
class FibrePacks {
 public:
  /// Throws as require_orthonormal.
  explicit FibrePacks(const FibreAxes& axes);
  Eigen::Index size() const { return size_; }
  /// The axes of one pack as matrices R = [f s n]; lanes without a point hold those of others.
  polyaffine::Mat3Pack at(polyaffine::PackPoints points) const {
    polyaffine::Mat3Pack R;
    for (int i = 0; i < 9; ++i) R.m[i] = polyaffine::load(rows_.col(i).data() + points.point);
    return R;
  }

 private:
  Eigen::Index size_;
  Eigen::Matrix<double, Eigen::Dynamic, 9> rows_;  // points × 9, and a pack of identities behind the last
};

}  // namespace cardiac
