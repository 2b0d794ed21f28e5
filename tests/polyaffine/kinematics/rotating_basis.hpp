#pragma once

#include <cmath>
#include <random>

#include <polyaffine/kinematics/basis.hpp>
#include <polyaffine/kinematics/lagrange.hpp>
#include "polyaffine/mesh/unit_cube.hpp"

namespace polyaffine::testing {

/// Four functions on the unit cube, N = 1 + xy, sin(y + z), x² − z, cos(xyz); the first and the last in axes
/// that turn by 0.7x + 0.3y − 0.5z about the third axis and then by 0.4z about the first.
class RotatingBasis : public Basis {
 public:
  RotatingBasis() : mesh_(unit_cube().points, unit_cube().tets), space_(mesh_, 1) {}

  const TetMesh& mesh() const { return mesh_; }
  const LagrangeBasis& space() const { return space_; }

  int num_functions() const override { return 4; }
  bool in_local_axes(int function) const override { return function == 0 || function == 3; }
  BasisSample sample(int tet, const Vec4& barycentric) const override {
    return at(space_.nodes()(Eigen::all, space_.elements().col(tet)) * barycentric);
  }

  static BasisSample at(const Vec3& X) {
    const double x = X[0], y = X[1], z = X[2];
    BasisSample s;
    s.functions = {0, 1, 2, 3};
    s.N = Vec4(1 + x * y, std::sin(y + z), x * x - z, std::cos(x * y * z));
    s.gradient.resize(3, 4);
    s.gradient.col(0) << y, x, 0;
    s.gradient.col(1) << 0, std::cos(y + z), std::cos(y + z);
    s.gradient.col(2) << 2 * x, 0, -1;
    s.gradient.col(3) = -std::sin(x * y * z) * Vec3(y * z, x * z, x * y);
    const double a = 0.7 * x + 0.3 * y - 0.5 * z, b = 0.4 * z;
    Mat3 A, dA, B, dB;
    A << std::cos(a), -std::sin(a), 0, std::sin(a), std::cos(a), 0, 0, 0, 1;
    dA << -std::sin(a), -std::cos(a), 0, std::cos(a), -std::sin(a), 0, 0, 0, 0;
    B << 1, 0, 0, 0, std::cos(b), -std::sin(b), 0, std::sin(b), std::cos(b);
    dB << 0, 0, 0, 0, -std::sin(b), -std::cos(b), 0, std::cos(b), -std::sin(b);
    s.Q = B * A;
    s.dQ = {0.7 * B * dA, 0.3 * B * dA, -0.5 * B * dA + 0.4 * dB * A};
    return s;
  }

  /// The displacement by its definition.
  static Vec3 displacement(const Vec3& X, const Vector& c) {
    const BasisSample s = at(X);
    return s.Q * (s.N[0] * c.segment<3>(0) + s.N[3] * c.segment<3>(9)) + s.N[1] * c.segment<3>(3) +
           s.N[2] * c.segment<3>(6);
  }

 private:
  TetMesh mesh_;
  LagrangeBasis space_;
};

inline Vector random_vector(Eigen::Index n, double size, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-size, size);
  return Vector::NullaryExpr(n, [&] { return uniform(random); });
}

}  // namespace polyaffine::testing
