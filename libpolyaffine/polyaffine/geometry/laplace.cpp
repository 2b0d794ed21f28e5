#include "polyaffine/geometry/laplace.hpp"

#include <Eigen/CholmodSupport>
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

Matrix smooth_projection(const LagrangeBasis& basis, const WallPoints& points, const Matrix& values,
                         double length) {
  const int n = basis.num_functions();
  std::vector<Eigen::Triplet<double>> entries;
  Matrix rhs = Matrix::Zero(n, values.rows());
  for (std::size_t t = 0; t + 1 < points.starts.size(); ++t) {
    std::vector<int> nodes;
    Matrix A;
    for (int q = points.starts[t]; q < points.starts[t + 1]; ++q) {
      const BasisSample s = basis.sample(static_cast<int>(t), points.barycentric.col(q));
      if (nodes.empty()) {
        nodes = s.functions;
        A.setZero(s.N.size(), s.N.size());
      }
      A +=
          points.weights[q] * (s.N * s.N.transpose() + length * length * s.gradient.transpose() * s.gradient);
      rhs(nodes, Eigen::all) += points.weights[q] * s.N * values.col(q).transpose();
    }
    for (std::size_t a = 0; a < nodes.size(); ++a)
      for (std::size_t b = 0; b < nodes.size(); ++b)
        if (nodes[b] <= nodes[a])
          entries.emplace_back(nodes[a], nodes[b],
                               A(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)));
  }
  Eigen::SparseMatrix<double> A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  const Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>, Eigen::Lower> solver(A);
  if (solver.info() != Eigen::Success) throw ComputationError("smoothing: the system is singular");
  return solver.solve(rhs).transpose();
}

}  // namespace polyaffine
