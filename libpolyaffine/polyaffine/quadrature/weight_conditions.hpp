#pragma once

#include <vector>

#include <polyaffine/core/types.hpp>
#include <polyaffine/kinematics/basis.hpp>
#include <polyaffine/mesh/tet_mesh.hpp>

namespace polyaffine {

/// Linear conditions A w = b on the weights of integration points (conditions × points); a miss of condition
/// i counts relative to scale[i].
struct WeightConditions {
  Matrix A;
  Vector b, scale;
};

/// Both sets of conditions on the same points. Throws std::invalid_argument when the numbers of points
/// differ.
WeightConditions stack(const WeightConditions& first, const WeightConditions& second);

/// ∮ N_a n dA over points that cover the whole boundary (3 × functions, mm²). Throws std::invalid_argument
/// when a function has local axes.
Points boundary_integrals(const Basis& basis, const SurfacePoints& boundary);

/// The integration constraint Σ_q w_q ∇N_a(X_q) = ∮ N_a n dA, three conditions a function, for the points of
/// a deformation table without local axes (std::invalid_argument otherwise). It is the divergence theorem for
/// the sum: with it, and only with it, a uniform stress σ has the internal forces σ ∮ N_a n dA, which the
/// tractions σn on the boundary balance, so that uniform stress is a solution (patch test; Chen et al. 2001
/// in meshfree methods). Weights without it leave the spurious force σ·(difference) on every function, which
/// tilts faces. Scale: the largest of the boundary integrals.
WeightConditions integration_constraint(const FieldTable& table, const Points& boundary_integrals);

/// The true volume and first moments of every region, Σ_{q in r} w_q {1, X_q − c_r} = {V_r, 0} with the
/// centre c_r of the region's volume, four conditions a region (scale V_r and V_r^{4/3}). `label`: region (0
/// … count − 1) of each tet; a point belongs to the region of its tet; X: 3 × points, mm. Throws InputError
/// when a region has no tet.
WeightConditions region_moments(const TetMesh& mesh, const std::vector<int>& label, int count,
                                const std::vector<int>& tet, const Points& X);

}  // namespace polyaffine
