#pragma once

#include <Eigen/SparseCore>
#include <functional>
#include <vector>

#include <polyaffine/core/types.hpp>
#include <polyaffine/kinematics/lagrange.hpp>

namespace polyaffine {

/// Value prescribed at a node.
struct NodeValue {
  int node = 0;
  double value = 0;
};

/// Solution of Δψ = 0 with the given node values and no flux elsewhere on the boundary, by linear or
/// quadratic elements; one value a node, in the unit of the given ones. Throws ComputationError when no node
/// is given or the system is singular.
Vector solve_laplace(const LagrangeBasis& basis, const std::vector<NodeValue>& dirichlet);

/// Coefficients at one point of a diffusion problem: conductivity D (symmetric, not negative) and the factor
/// f > 0 with its gradient (1/mm).
struct DiffusionPoint {
  Mat3 conductivity = Mat3::Identity();
  double factor = 1;
  Vec3 factor_gradient = Vec3::Zero();
};

/// The linear system of ∇·(D ∇(f ψ)) = 0 for the nodal ψ, assembled once for any prescribed values. A factor
/// takes out of the unknown what polynomials follow badly: f the distance from a line lets f ψ have a cone
/// there.
class DiffusionProblem {
 public:
  /// `at` is called with the index of a point of `points`, one block an element.
  DiffusionProblem(const LagrangeBasis& basis, const WallPoints& points,
                   const std::function<DiffusionPoint(std::size_t)>& at);

  /// ψ given at some nodes and no flux elsewhere on the boundary. Throws ComputationError when no node is
  /// given or the system is singular.
  Vector solve(const std::vector<NodeValue>& dirichlet) const;

 private:
  // Finds the values that have a place among the `count` unknowns (−1: none).
  void solve_free(const std::vector<int>& unknown, int count, Vector& values) const;

  std::vector<int> number_;  // row of each node
  Eigen::SparseMatrix<double> matrix_;
  std::vector<int> vertices_;  // rows of the vertices
  // From linear to quadratic functions; without columns for linear elements.
  Eigen::SparseMatrix<double> interpolation_;
};

/// Δψ = 0 (D = 1, f = 1).
DiffusionProblem laplace_problem(const LagrangeBasis& basis);

/// One solution of a problem; see DiffusionProblem.
Vector solve_diffusion(const LagrangeBasis& basis, const WallPoints& points,
                       const std::function<DiffusionPoint(std::size_t)>& at,
                       const std::vector<NodeValue>& dirichlet);

}  // namespace polyaffine
