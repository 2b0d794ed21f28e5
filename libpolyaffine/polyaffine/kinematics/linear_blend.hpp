#pragma once

#include <polyaffine/core/types.hpp>

namespace polyaffine {

/// B (4n × m) with blocks φ_i(X_j) [X_j; 1] for weights φ (n × m) at points X (3 × m, mm). The position map
/// and its transpose are products with it:
///   positions  x = T B   (3 × m), T = [T_1 … T_n] (3 × 4n), T_i = [A_i | t_i];
///   forces     F = f Bᵀ  (3 × 4n), the full generalised force Σ_j φ_i(X_j) f_j [X_j; 1]ᵀ of every frame.
/// Throws std::invalid_argument when the sizes differ.
Matrix blend_matrix(const Matrix& weights, const Points& points);

/// x(X_j) = Σ_i φ_i(X_j) T_i [X_j; 1] (3 × m, mm) for frames T (3 × 4n).
Points blend_positions(const Matrix& weights, const Points& frames, const Points& points);

/// F_i = Σ_j φ_i(X_j) f_j [X_j; 1]ᵀ (3 × 4n) for forces f (3 × m, mN): ⟨f, ẋ⟩ = ⟨F, Ṫ⟩ for every Ṫ.
/// Columns 4i … 4i+2 are mN·mm, column 4i+3 the resultant in mN.
Points blend_forces(const Matrix& weights, const Points& points, const Points& forces);

/// F = ∂x/∂X = Σ_i φ_i A_i + (A_i X + t_i) ⊗ ∇φ_i at one point; weights (n), their gradients (3 × n, 1/mm).
Mat3 blend_gradient(const Vector& weights, const Points& gradients, const Points& frames, const Vec3& point);

}  // namespace polyaffine
