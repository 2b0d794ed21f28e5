#pragma once

#include <Eigen/Core>
#include <numbers>

/// Reduced and full-order solid mechanics.
///
/// One coherent set of units throughout: mm, ms, kPa, mg. Then force is mN, energy µJ, density mg/mm³ = g/mL,
/// viscosity kPa·ms.
namespace polyaffine {

using Vec3 = Eigen::Vector3d;
using Vec4 = Eigen::Vector4d;
using Mat3 = Eigen::Matrix3d;
using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;
using Points = Eigen::Matrix3Xd;  ///< one point a column, mm
using Tets = Eigen::Matrix4Xi;    ///< four vertex indices a column
using Triangles = Eigen::Matrix3Xi;

inline constexpr double kPi = std::numbers::pi;

}  // namespace polyaffine

// Alignment of Eigen's types and of the memory they allocate would follow the processor flags of each
// compilation. The targets of CMake define both; who compiles without CMake must, as -D or before the first
// header of Eigen.
#if EIGEN_MAX_ALIGN_BYTES != 32 || EIGEN_MAX_STATIC_ALIGN_BYTES != 32
#error "polyaffine: compile with -DEIGEN_MAX_ALIGN_BYTES=32 -DEIGEN_MAX_STATIC_ALIGN_BYTES=32"
#endif
