#pragma once

#include <vector>

#include <polyaffine/core/types.hpp>

namespace polyaffine {

/// Functions seen by a block of points, with their rows at each point.
///
/// Point q of the block carries d rows per function (for instance the three components of ∇N_a), stored as
/// the columns [d·q, d·q + d) of `rows`. With coefficients c_a the functions form the 3×d matrix Y_q = Σ_a
/// c_a ⊗ row_a. Without lift d = 3 and Y_q itself is added to the field; with lift (functions in local axes)
/// vec(Y_q) is first mapped by the 9×3d matrix lift[q]. A group of modes has no rows: function a adds
/// Σ_k c_ak m_ak, nine numbers m_ak for each of its three modes.
struct FunctionGroup {
  using Lift = Eigen::Matrix<double, 9, Eigen::Dynamic, Eigen::ColMajor, 9, 12>;

  std::vector<int> functions;  ///< function indices a
  int d = 3;
  Matrix rows;             ///< functions × (d · points)
  std::vector<Lift> lift;  ///< empty, or one a point
  Matrix modes;            ///< of modes only, d = 9: (3 · functions) × (9 · points), row 3a + k for m_ak

  bool is_modes() const { return modes.size() > 0; }
};

/// Consecutive points [first, first + count) that see the same functions.
struct PointBlock {
  int first = 0;
  int count = 0;
  std::vector<FunctionGroup> groups;

  int num_functions() const;
  /// Function indices of all groups, in order; the local numbering of block vectors and matrices.
  std::vector<int> functions() const;
};

/// A 3×3 field over integration points that depends linearly on the coefficients c of vector-valued
/// functions: M_q(c) = M⁰_q + Σ_groups lift_q(Σ_a c_a ⊗ row_a). In the wall M = F, M⁰ = I and the rows are
/// ∇N_a (F = I + Σ c_a ⊗ ∇N_a); on a surface M = [x, x_ξ, x_η]. Finite elements and reduced frames differ
/// only in the content of this table. Unknown 3a + k is component k of c_a.
struct FieldTable {
  int num_functions = 0;
  Vector weights;  ///< integration weight of each point
  Matrix base;     ///< 9 × points, M⁰ column-major; empty means the identity everywhere
  std::vector<PointBlock> blocks;

  int num_points() const { return static_cast<int>(weights.size()); }
  int num_unknowns() const { return 3 * num_functions; }
};

/// Coefficients of a block's functions, 3 × functions, gathered from the vector of unknowns.
Matrix gather(const PointBlock& block, const Vector& c);
/// The field at the points of a block for gathered coefficients: adds to the 9 × count array.
void add_field(const PointBlock& block, const Matrix& coefficients, double* field);
/// The exact transpose of add_field: adds the 3 × functions force of 9 × count values S.
void add_field_transpose(const PointBlock& block, const double* S, Matrix& force);
/// M_q at all points, 9 × points.
Matrix evaluate_field(const FieldTable& table, const Vector& c);

}  // namespace polyaffine
