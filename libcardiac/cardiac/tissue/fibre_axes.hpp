#pragma once

#include <Eigen/Core>

#include <polyaffine/material/batch.hpp>

namespace cardiac {

/// Local tissue axes, one column of nine numbers a point: fibre f, sheet s, sheet normal n, each a unit
/// vector in the axes of the reference configuration.
using FibreAxes = Eigen::Matrix<double, 9, Eigen::Dynamic>;

/// Throws polyaffine::InputError that names the first point whose axes are not orthonormal to 10⁻⁶.
void require_orthonormal(const FibreAxes& axes);

/// The axes of one pack of points as matrices R = [f s n].
inline polyaffine::Mat3Pack pack_axes(const FibreAxes& axes, polyaffine::PackPoints points) {
  polyaffine::Mat3Pack R;
  const double* data = axes.data() + 9 * static_cast<Eigen::Index>(points.point);
  for (int i = 0; i < 9; ++i) R.m[i] = polyaffine::gather(data + i, 9, points.lanes);
  return R;
}

}  // namespace cardiac
