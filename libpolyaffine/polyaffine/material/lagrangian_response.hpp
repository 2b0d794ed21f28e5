#pragma once

#include <polyaffine/material/volumetric_response.hpp>

namespace polyaffine {

/// Place of entry ij of a symmetric 3×3 matrix among 00, 11, 22, 01, 12, 02. Entries are tensor components
/// (no factor 2 on shears).
inline constexpr int kVoigt[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
inline constexpr int kVoigtRow[6] = {0, 1, 2, 0, 1, 0};
inline constexpr int kVoigtColumn[6] = {0, 1, 2, 1, 2, 2};

/// Symmetric matrices of one pack of points.
struct SymPack {
  Pack v[6];
  Pack& operator()(int i, int j) { return v[kVoigt[i][j]]; }
  const Pack& operator()(int i, int j) const { return v[kVoigt[i][j]]; }
};

/// Energy W(E), second Piola–Kirchhoff stress S = ∂W/∂E (6) and CC = ∂S/∂E (6×6, symmetric, all entries
/// filled), E = (C − I)/2.
struct LagrangianResponse {
  Pack W;
  SymPack S;
  Pack CC[6][6];
};

/// C = FᵀF.
SymPack right_cauchy_green(const Mat3Pack& F);

/// A : B of two symmetric matrices.
[[gnu::always_inline]] inline Pack contract(const SymPack& A, const SymPack& B) {
  return A.v[0] * B.v[0] + A.v[1] * B.v[1] + A.v[2] * B.v[2] +
         2 * (A.v[3] * B.v[3] + A.v[4] * B.v[4] + A.v[5] * B.v[5]);
}

/// The isochoric part of a deformation: C̄ = J^(−2/3) C.
struct IsochoricStrain {
  Pack g;  ///< J^(−2/3)
  SymPack C_bar;
  SymPack C_inverse;
};
IsochoricStrain isochoric_strain(const SymPack& C, const LoosePack& J);

/// Turns a response to C̄ (W̄, S̄ = 2∂W̄/∂C̄, C̄C̄ = 2∂S̄/∂C̄) into the response of W(C) = W̄(J^(−2/3) C):
///   S  = J^(−2/3) S̄ − ⅓ (S̄:C̄) C⁻¹,
///   CC = ℙ : J^(−4/3) C̄C̄ : ℙᵀ + ⅔ (S̄:C̄)(C⁻¹⊙C⁻¹ − ⅓ C⁻¹⊗C⁻¹) − ⅔ (C⁻¹⊗S + S⊗C⁻¹),  ℙ = 𝕀 − ⅓ C⁻¹⊗C
/// (Holzapfel 2000, eqs. 6.90 and 6.168).
void make_isochoric(const IsochoricStrain& strain, bool tangent, LagrangianResponse& r);

/// Adds W, P = F S and the geometric part δ_ik S_JL of A: all there is for a stress that does not depend on
/// F.
void add_constant_stress(const Mat3Pack& F, const LoosePack& W, const SymPack& S, bool tangent,
                         PackResponse& r);

/// Adds W, P = F S and A_iJkL = δ_ik S_JL + F_iM F_kN CC_MJNL.
void add_lagrangian(const Mat3Pack& F, const LagrangianResponse& l, bool tangent, PackResponse& r);

/// F R: the deformation gradient with its reference side in the local axes that are the columns of R.
Mat3Pack to_local_axes(const Mat3Pack& F, const Mat3Pack& R);

/// Takes a response computed with F R back to the axes of F: P = P' Rᵀ, A_iJkL = R_Ja R_Lb A'_iakb.
void from_local_axes(const Mat3Pack& R, bool tangent, PackResponse& r);

}  // namespace polyaffine
