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

/// Smooth nodal field f (components × nodes) from values g at points of the wall (components × points), the
/// minimiser of ∫ |f − g|² + length² |∇f|²: an L2 projection with a Helmholtz filter that removes what varies
/// over less than about `length` (mm). The points are those of basis.wall_points(degree ≥ 4).
Matrix smooth_projection(const LagrangeBasis& basis, const WallPoints& points, const Matrix& values,
                         double length);

}  // namespace polyaffine
