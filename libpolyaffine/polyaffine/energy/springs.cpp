#include "polyaffine/energy/springs.hpp"

#include <polyaffine/material/parameters.hpp>

namespace polyaffine {

SurfaceSpring::SurfaceSpring(double stiffness) : stiffness_(stiffness) {
  require_positive("spring stiffness", stiffness, "kPa/mm");
}

SurfaceSpring::SurfaceSpring(double stiffness, Points normals) : SurfaceSpring(stiffness) {
  normals_ = std::move(normals);
}

void SurfaceSpring::evaluate(int first, int count, const double* M, PointState, double* W, double* P,
                             double* A) const {
  for (int q = 0; q < count; ++q) {
    Mat3 k = stiffness_ * Mat3::Identity();
    if (normals_.size() > 0) k = stiffness_ * normals_.col(first + q) * normals_.col(first + q).transpose();
    const Vec3 u = Eigen::Map<const Vec3>(M + 9 * q);
    const Vec3 f = k * u;
    if (W) W[q] += 0.5 * u.dot(f);
    if (P) Eigen::Map<Vec3>(P + 9 * q) += f;
    if (A) Eigen::Map<Eigen::Matrix<double, 9, 9>>(A + 81 * q).topLeftCorner<3, 3>() += k;
  }
}

void DeadTraction::evaluate(int, int count, const double* M, PointState, double* W, double* P,
                            double*) const {
  for (int q = 0; q < count; ++q) {
    if (W) W[q] -= traction_.dot(Eigen::Map<const Vec3>(M + 9 * q));
    if (P) Eigen::Map<Vec3>(P + 9 * q) -= traction_;
  }
}

}  // namespace polyaffine
