#pragma once

#include <vector>

#include <polyaffine/system/pressure_space.hpp>

namespace polyaffine {

/// How well displacements control pressures. With D_bj = ∫ Ψ_b div u_j, M_bc = ∫ Ψ_b Ψ_c and A_ij = ∫ ε(u_i)
/// : ε(u_j) the singular values of M^(−1/2) D A^(−1/2) are the stationary values of
///   ∫ p div u / (‖p‖ ‖ε(u)‖),
/// and the smallest one is the inf-sup constant β of the pair (Boffi, Brezzi & Fortin 2013, §3.4.3). One that
/// is zero belongs to a pressure that no displacement feels: it is left undetermined and the displacement has
/// a constraint less than there are pressures.
struct InfSup {
  int displacements = 0;  ///< unknowns that are free
  int pressures = 0;
  Vector singular_values;  ///< one a pressure, increasing
  int spurious = 0;        ///< of them below `kSpurious` of the largest
  static constexpr double kSpurious = 1e-6;

  double beta() const { return singular_values[0]; }
};

/// Of the functions and the pressure space at their integration points, dense: meant for reduced models.
/// `fixed` by unknown, empty: none. Throws ComputationError when the points see no strain of some motion, or
/// when M is singular.
InfSup inf_sup(const FieldTable& table, const PressureSpace& space, const std::vector<char>& fixed = {});

}  // namespace polyaffine
