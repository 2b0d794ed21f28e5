#include "polyaffine/kinematics/gmls.hpp"

#include <Eigen/Cholesky>
#include <array>
#include <stdexcept>

#include <polyaffine/core/error.hpp>

namespace polyaffine {

GmlsValues gmls_functions(const Vec3& x, const Points& nodes, const Vector& weights, const Points& gradients,
                          double length) {
  using Mat4 = Eigen::Matrix4d;
  const Eigen::Index n = nodes.cols();
  if (weights.size() != n || gradients.cols() != n || !(length > 0))
    throw std::invalid_argument("gmls_functions: sizes differ or the length is not positive");

  // The origin of p is put at x: a shift of it changes neither functions nor gradients and keeps M well
  // scaled.
  Eigen::Matrix4Xd p(4, n);
  p.row(0).setOnes();
  p.bottomRows(3) = (nodes.colwise() - x) / length;
  Mat4 derivatives = Mat4::Identity();
  derivatives(0, 0) = 0;
  Mat4 moment = p * weights.asDiagonal() * p.transpose() + weights.sum() * derivatives;
  const Eigen::LDLT<Mat4> factor(moment);
  if (!(weights.sum() > 0) || factor.info() != Eigen::Success || !(factor.vectorD().minCoeff() > 0))
    throw ComputationError("GMLS: the weights of the nodes vanish at a point");

  const Vec4 g = factor.solve(Vec4::Unit(0));
  std::array<Vec4, 3> dg;  // times length
  for (int k = 0; k < 3; ++k) {
    const Vector dw = length * gradients.row(k).transpose();
    const Mat4 dm = p * dw.asDiagonal() * p.transpose() + dw.sum() * derivatives;
    dg[k] = factor.solve(Vec4::Unit(k + 1) - dm * g);
  }
  GmlsValues result{Vector(4 * n), Points(3, 4 * n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    Mat4 basis = derivatives;  // columns p_i, ∂_1 p, ∂_2 p, ∂_3 p
    basis.col(0) = p.col(i);
    result.values.segment<4>(4 * i) = weights[i] * (basis.transpose() * g);
    for (int k = 0; k < 3; ++k)
      result.gradients.block<1, 4>(k, 4 * i) =
          (gradients(k, i) * g + weights[i] / length * dg[k]).transpose() * basis;
  }
  return result;
}

}  // namespace polyaffine
