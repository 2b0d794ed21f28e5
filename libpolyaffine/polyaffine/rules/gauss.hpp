#pragma once

#include <vector>

#include <polyaffine/core/types.hpp>
#include <polyaffine/mesh/tet_mesh.hpp>

namespace polyaffine {

/// A rule on the reference tetrahedron: barycentric points (a column each), weights that sum to one.
struct TetRule {
  Eigen::Matrix4Xd barycentric;
  Vector weights;
};

struct TriangleRule {
  Eigen::Matrix3Xd barycentric;
  Vector weights;
};

/// A rule on [0, 1]: points in ascending order, weights that sum to one.
struct LineRule {
  Vector points;
  Vector weights;
};

/// Symmetric rule, exact for polynomials of total degree `degree` (1 to 6); all weights are positive, all
/// points inside. Points: 1, 4, 8, 14, 14, 24 (Keast 1986; Walkington 2000; Zhang, Cui, Liu 2009).
/// Throws std::invalid_argument for another degree.
TetRule tet_rule(int degree);

/// Symmetric rule, exact for polynomials of total degree `degree` (1 to 6); all weights are positive, all
/// points inside. Points: 1, 3, 6, 6, 7, 12 (Dunavant 1985). Throws std::invalid_argument for another degree.
TriangleRule triangle_rule(int degree);

/// Gauss–Legendre with n ≥ 1 points on [0, 1], exact to degree 2n − 1. Throws std::invalid_argument for n
/// < 1.
LineRule line_rule(int n);

/// Points in the tets of a mesh: tet index, barycentric coordinates (a column each) and weight (mm³).
struct QuadraturePoints {
  std::vector<int> tet;
  Eigen::Matrix4Xd barycentric;
  Vector weights;

  int size() const { return static_cast<int>(tet.size()); }
};

/// The points of tet_rule(degree) in every tet, tet after tet; the weights sum to the mesh volume (mm³).
QuadraturePoints gauss_points(const TetMesh& mesh, int degree);

/// X = Σ_k λ_k x_k of every point (3 × n, mm).
Points positions(const TetMesh& mesh, const QuadraturePoints& points);

/// Values at the points of a field given at the vertices and linear in every tet.
Vector interpolate(const TetMesh& mesh, const Vector& vertex_values, const QuadraturePoints& points);

}  // namespace polyaffine
