#include "polyaffine/geometry/laplace.hpp"

#include <Eigen/CholmodSupport>
#include <Eigen/SparseCore>

#include <polyaffine/core/error.hpp>
#include <polyaffine/core/serial_blas.hpp>

namespace polyaffine {
namespace {

Matrix element_matrix(const LagrangeBasis& basis, const WallPoints& points,
                      const std::function<DiffusionPoint(std::size_t)>& at, std::size_t t) {
  Matrix K = Matrix::Zero(basis.elements().rows(), basis.elements().rows());
  for (int q = points.starts[t]; q < points.starts[t + 1]; ++q) {
    const BasisSample s = basis.sample(points.tet[q], points.barycentric.col(q));
    const DiffusionPoint d = at(static_cast<std::size_t>(q));
    const Points gradient = d.factor * s.gradient + d.factor_gradient * s.N.transpose();
    K += points.weights[q] * gradient.transpose() * d.conductivity * gradient;
  }
  return K;
}

DiffusionPoint plain(std::size_t) {
  return {};
}

}  // namespace

Vector solve_laplace(const LagrangeBasis& basis, const std::vector<NodeValue>& dirichlet) {
  // |∇N|² of quadratic functions on straight elements
  return solve_diffusion(basis, basis.wall_points(2), plain, dirichlet);
}

Vector solve_diffusion(const LagrangeBasis& basis, const WallPoints& points,
                       const std::function<DiffusionPoint(std::size_t)>& at,
                       const std::vector<NodeValue>& dirichlet) {
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

  std::vector<Eigen::Triplet<double>> entries;
  Vector rhs = Vector::Zero(num_free);
  for (std::size_t t = 0; t + 1 < points.starts.size(); ++t) {
    const Matrix K = element_matrix(basis, points, at, t);
    const auto nodes = basis.elements().col(points.tet[points.starts[t]]);
    for (Eigen::Index a = 0; a < nodes.size(); ++a) {
      if (free_index[nodes[a]] < 0) continue;
      for (Eigen::Index b = 0; b < nodes.size(); ++b) {
        if (free_index[nodes[b]] < 0)
          rhs[free_index[nodes[a]]] -= K(a, b) * solution[nodes[b]];
        else if (free_index[nodes[b]] <= free_index[nodes[a]])
          entries.emplace_back(free_index[nodes[a]], free_index[nodes[b]], K(a, b));
      }
    }
  }
  Eigen::SparseMatrix<double> A(num_free, num_free);
  A.setFromTriplets(entries.begin(), entries.end());
  const SerialBlas serial;
  const Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>, Eigen::Lower> solver(A);
  if (solver.info() != Eigen::Success) throw ComputationError("Laplace problem: the system is singular");
  const Vector x = solver.solve(rhs);
  for (int i = 0; i < n; ++i)
    if (free_index[i] >= 0) solution[i] = x[free_index[i]];
  return solution;
}

}  // namespace polyaffine
