#pragma once

#include <memory>
#include <vector>

#include <polyaffine/linear/held_direction.hpp>

namespace polyaffine {

/// A symmetric tangent stiffness K that energies add their blocks to, and its factorisation. Unknowns that
/// are fixed keep their row and column as those of the identity, so that a right-hand side of zero leaves
/// them alone.
class LinearSystem {
 public:
  virtual ~LinearSystem() = default;
  virtual void set_zero() = 0;
  /// Adds a (3n)² block over n functions (unknown 3a + k of function a).
  virtual void add(const std::vector<int>& functions, const Matrix& K) = 0;
  /// Adds a matrix over all unknowns; only for systems stored densely (std::logic_error otherwise).
  virtual void add_dense(const Matrix& K) = 0;
  /// Adds factor · XᵀX, X with a column for each unknown; for the same systems.
  virtual void add_gram(const Matrix& X, double factor) { add_dense(factor * X.transpose() * X); }
  /// False when the matrix is not finite or singular to working precision (dense: elimination leaves less
  /// than 1e-13 of a diagonal entry, or the reciprocal condition is below 1e-14).
  virtual bool factorise() = 0;
  /// Solves with the last factorisation; one right-hand side a column.
  virtual Matrix solve(const Matrix& rhs) const = 0;
  /// True when the last factorisation was a Cholesky, so that the matrix is positive definite.
  virtual bool positive_definite() const = 0;
};

/// Dense storage, Cholesky with LU with partial pivoting as the fallback where K is indefinite. Of held
/// directions n only the part P K P + n nᵀ is left, P = I − n nᵀ, as the identity is of fixed unknowns.
std::unique_ptr<LinearSystem> dense_system(int num_unknowns, const std::vector<char>& fixed = {},
                                           const HeldDirections& held = {});

}  // namespace polyaffine
