#pragma once

#include <cmath>

#include <polyaffine/core/types.hpp>
#include <polyaffine/quadrature/moment_compression.hpp>

namespace polyaffine {

/// Trains a sparse integration rule: of many candidate points few are kept, with factors on their weights
/// that are not negative, so that given integrals (generalised forces of states computed beforehand) come out
/// as a finer rule has them (An, Kim and James 2008; Hernández, Caicedo and Ferrer 2017). Errors are measured
/// in a norm of the caller: in the energy norm eᵀK⁻¹e errors of a force are those of the displacement.
class CubatureTraining {
 public:
  explicit CubatureTraining(Eigen::Index candidates);
  /// Whether there is nothing to keep yet.
  bool empty() const { return norm_ == 0; }
  /// ‖targets‖ over all integrals.
  double norm() const { return std::sqrt(norm_); }
  /// Integrals to keep: row i of `contributions` holds what each candidate adds to integral i with its own
  /// weight, `target` what they shall sum to; `dual` = N [contributions, target] with the symmetric positive
  /// semidefinite matrix N of the norm.
  void add(const Matrix& contributions, const Vector& target, const Matrix& dual);
  /// Candidates and the factors (> 0) on their weights with an error of `accuracy` times the norm of all
  /// targets, if there are such; `residual` is the relative error reached. Non-negative least squares on a
  /// pivoted Cholesky factor of the normal equations.
  CompressedRule select(double accuracy) const;

 private:
  Matrix gram_;      // lower triangle of Σ AᵀNA
  Vector products_;  // Σ AᵀNt
  double norm_ = 0;  // Σ tᵀNt
};

}  // namespace polyaffine
