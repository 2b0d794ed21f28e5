#pragma once

#include <cmath>
#include <vector>

#include <polyaffine/kinematics/lagrange.hpp>

namespace polyaffine::testing {

/// L2 error of nodal values (components × nodes) against an exact field, by Gauss points of degree 6.
template <class Exact>
double l2_error(const LagrangeBasis& basis, const Matrix& nodal, const Exact& exact) {
  const WallPoints points = basis.wall_points(6);
  double sum = 0;
  for (std::size_t q = 0; q < points.tet.size(); ++q) {
    const auto k = static_cast<Eigen::Index>(q);
    const BasisSample s = basis.sample(points.tet[q], points.barycentric.col(k));
    const Vec3 X = basis.nodes()(Eigen::all, s.functions) * s.N;
    const Vector value = nodal(Eigen::all, s.functions) * s.N;
    sum += points.weights[k] * (value - Vector(exact(X))).squaredNorm();
  }
  return std::sqrt(sum);
}

/// Order between two meshes of which the second has half the size.
inline double order(double coarse, double fine) {
  return std::log2(coarse / fine);
}

}  // namespace polyaffine::testing
