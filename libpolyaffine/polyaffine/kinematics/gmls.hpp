#pragma once

#include <polyaffine/core/types.hpp>

namespace polyaffine {

/// GMLS shape functions at a point, column 4i + m for node i: m = 0 its value function N_i, m = 1…3 its
/// derivative functions N_i^k (all without unit). gradients: 3 × 4n, 1/mm.
struct GmlsValues {
  Vector values;
  Points gradients;
};

/// Generalised moving least squares with nodes q_i (3 × n, mm), weights w_i (n) and their gradients (3 × n,
/// 1/mm) at the point x (mm). Lengths are divided by `length` (mm, the size of a region), so
///   f(x) = Σ_i N_i f(q_i) + Σ_ik N_i^k · length · ∂_k f(q_i)
/// holds exactly for every affine f. With p = [1, x, y, z]/length, X_i = p_i p_iᵀ + diag(0,1,1,1),
/// M = Σ w_i X_i: N_i = w_i pᵀM⁻¹p_i, N_i^k = w_i pᵀM⁻¹∂_k p (Martin et al. 2010).
/// Throws std::invalid_argument when sizes differ, ComputationError when all weights vanish.
GmlsValues gmls_functions(const Vec3& x, const Points& nodes, const Vector& weights, const Points& gradients,
                          double length);

}  // namespace polyaffine
