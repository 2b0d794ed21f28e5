#pragma once

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

/// Gradient of a nodal field at the nodes, the volume-weighted mean over the elements that meet there; 3 ×
/// nodes.
Points recovered_gradient(const LagrangeBasis& basis, const Vector& nodal);

}  // namespace polyaffine
