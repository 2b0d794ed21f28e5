#include "polyaffine/kinematics/linear_blend.hpp"

#include <Eigen/Geometry>

#include <stdexcept>

namespace polyaffine {
namespace {

void check(bool sizes_agree) {
  if (!sizes_agree) throw std::invalid_argument("linear blend: sizes of weights, frames and points differ");
}

}  // namespace

Matrix blend_matrix(const Matrix& weights, const Points& points) {
  check(weights.cols() == points.cols());
  Matrix b(4 * weights.rows(), points.cols());
  for (Eigen::Index j = 0; j < points.cols(); ++j)
    for (Eigen::Index i = 0; i < weights.rows(); ++i)
      b.col(j).segment<4>(4 * i) = weights(i, j) * points.col(j).homogeneous();
  return b;
}

Points blend_positions(const Matrix& weights, const Points& frames, const Points& points) {
  check(frames.cols() == 4 * weights.rows());
  return frames * blend_matrix(weights, points);
}

Points blend_forces(const Matrix& weights, const Points& points, const Points& forces) {
  check(forces.cols() == points.cols());
  return forces * blend_matrix(weights, points).transpose();
}

Mat3 blend_gradient(const Vector& weights, const Points& gradients, const Points& frames, const Vec3& point) {
  check(frames.cols() == 4 * weights.size() && gradients.cols() == weights.size());
  Mat3 f = Mat3::Zero();
  for (Eigen::Index i = 0; i < weights.size(); ++i) {
    const Eigen::Matrix<double, 3, 4> frame = frames.middleCols<4>(4 * i);
    f += weights[i] * frame.leftCols<3>() + frame * point.homogeneous() * gradients.col(i).transpose();
  }
  return f;
}

}  // namespace polyaffine
