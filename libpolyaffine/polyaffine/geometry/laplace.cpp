#include "polyaffine/geometry/laplace.hpp"

#include <Eigen/CholmodSupport>
#include <Eigen/LU>
#include <Eigen/SparseCore>

#include <polyaffine/core/error.hpp>

namespace polyaffine {

Vector solve_laplace(const LagrangeBasis& basis, const std::vector<NodeValue>& dirichlet) {
  const int n = basis.num_functions();
  Vector solution = Vector::Zero(n);
  std::vector<int> free_index(n, 0);
  for (const auto& [node, value] : dirichlet) {
    free_index[node] = -1;
    solution[node] = value;
  }
  if (dirichlet.empty()) throw ComputationError("Laplace problem: no boundary value is given");
  int num_free = 0;
  for (int& f : free_index)
    if (f >= 0) f = num_free++;

  const WallPoints points = basis.wall_points(2);  // |∇N|² of quadratic functions on straight elements
  std::vector<Eigen::Triplet<double>> entries;
  Vector rhs = Vector::Zero(num_free);
  for (std::size_t t = 0; t + 1 < points.starts.size(); ++t) {
    Matrix K;
    std::vector<int> nodes;
    for (int q = points.starts[t]; q < points.starts[t + 1]; ++q) {
      const BasisSample s = basis.sample(static_cast<int>(t), points.barycentric.col(q));
      if (nodes.empty()) {
        nodes = s.functions;
        K.setZero(s.gradient.cols(), s.gradient.cols());
      }
      K += points.weights[q] * s.gradient.transpose() * s.gradient;
    }
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      if (free_index[nodes[a]] < 0) continue;
      for (std::size_t b = 0; b < nodes.size(); ++b) {
        const double k = K(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
        if (free_index[nodes[b]] < 0)
          rhs[free_index[nodes[a]]] -= k * solution[nodes[b]];
        else if (free_index[nodes[b]] <= free_index[nodes[a]])
          entries.emplace_back(free_index[nodes[a]], free_index[nodes[b]], k);
      }
    }
  }
  Eigen::SparseMatrix<double> A(num_free, num_free);
  A.setFromTriplets(entries.begin(), entries.end());
  Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>, Eigen::Lower> solver(A);
  if (solver.info() != Eigen::Success) throw ComputationError("Laplace problem: the system is singular");
  const Vector x = solver.solve(rhs);
  for (int i = 0; i < n; ++i)
    if (free_index[i] >= 0) solution[i] = x[free_index[i]];
  return solution;
}

Points recovered_gradient(const LagrangeBasis& basis, const Vector& nodal) {
  Points sum = Points::Zero(3, basis.num_functions());
  Vector weight = Vector::Zero(basis.num_functions());
  Eigen::Matrix4Xd corners(4, basis.order() == 1 ? 4 : 10);
  corners.leftCols<4>().setIdentity();
  if (basis.order() == 2) {
    const int edges[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};
    for (int e = 0; e < 6; ++e)
      corners.col(4 + e) = 0.5 * (corners.col(edges[e][0]) + corners.col(edges[e][1]));
  }
  for (int t = 0; t < static_cast<int>(basis.elements().cols()); ++t) {
    const double volume = basis.jacobian(t, Vec4::Constant(0.25)).determinant() / 6;
    const Vector values = nodal(basis.elements().col(t));
    for (Eigen::Index k = 0; k < corners.cols(); ++k) {
      const int node = basis.elements()(k, t);
      sum.col(node) += volume * (basis.sample(t, corners.col(k)).gradient * values);
      weight[node] += volume;
    }
  }
  return sum.array().rowwise() / weight.transpose().array();
}

}  // namespace polyaffine
