#pragma once

#include <vector>

#include <polyaffine/kinematics/field_table.hpp>

namespace polyaffine {

/// A space of pressures p(X) = Σ_b p_b Ψ_b(X) that carries the volumetric energy of a nearly incompressible
/// wall:
///   g_b = ∫ Ψ_b (J − 1),  M_bc = ∫ Ψ_b Ψ_c,  W_vol = κ/2 gᵀ M⁻¹ g,  p = κ M⁻¹ g.
/// It is the static condensation of the mixed form with penalty κ; with one indicator function a region it is
/// the mean dilatation method (Nagtegaal, Parks & Rice 1974; Simo, Taylor & Pister 1985). Few pressures keep
/// the wall's volume without locking its displacement.
struct PressureSpace {
  /// Ψ at the points of one block of the field table.
  struct Block {
    std::vector<int> functions;  ///< indices b
    Matrix values;               ///< functions × points of the block
  };

  double bulk_modulus = 0;  ///< κ, kPa
  /// True: κ stands for infinity in the mixed form, g_b = 0 exactly, and is only the penalty that keeps its
  /// tangent positive definite (augmented Lagrangian); without independent pressures it stays a bulk modulus.
  bool incompressible = false;
  int num_functions = 0;
  std::vector<Block> blocks;  ///< one for each block of the table
  Matrix mass = {};           ///< M where it is known better than by the points of the table; else empty
};

/// g_b = Σ_q w_q Ψ_b (J − 1) of the determinants at all points.
Vector dilatation(const PressureSpace& space, const FieldTable& table, const Vector& J);
/// M p.
Vector pressure_mass(const PressureSpace& space, const FieldTable& table, const Vector& p);

/// M⁻¹ of a pressure space. Where every function lives in one block only (one pressure an element) it is kept
/// block by block, otherwise as one dense matrix.
class InverseMass {
 public:
  InverseMass() = default;
  /// Throws ComputationError when M is singular: a function without points, or linearly dependent functions.
  InverseMass(const PressureSpace& space, const FieldTable& table);
  bool local() const { return local_; }
  const Matrix& block(std::size_t k) const { return blocks_[k]; }
  /// M⁻¹ x, columns of x by pressure function.
  Matrix apply(const Matrix& x) const;
  /// L⁻¹ x with M = LLᵀ, of a mass that is kept as one matrix: its products are those with M⁻¹.
  Matrix half(const Matrix& x) const { return half_.triangularView<Eigen::Lower>() * x; }

 private:
  bool local_ = false;
  std::vector<std::vector<int>> functions_;
  std::vector<Matrix> blocks_;
  Matrix dense_, half_;
};

/// One constant pressure a block: with one element a block the mean dilatation of each element.
PressureSpace block_pressure(const FieldTable& table, double bulk_modulus, bool incompressible = false);
/// One constant pressure a region; `region` gives the region index (0-based) of each point. A block whose
/// points lie in several regions is handled.
PressureSpace region_pressure(const FieldTable& table, const std::vector<int>& region, int num_regions,
                              double bulk_modulus);

/// Pressure functions given by their values at all points of the table (functions × points); each block keeps
/// those that do not vanish in it.
PressureSpace dense_pressure(const FieldTable& table, const Matrix& values, double bulk_modulus);

}  // namespace polyaffine
