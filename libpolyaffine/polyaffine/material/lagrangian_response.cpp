#include <polyaffine/material/lagrangian_response.hpp>

namespace polyaffine {

SymPack right_cauchy_green(const Mat3Pack& F) {
  SymPack C;
#pragma GCC unroll 6
  for (int a = 0; a < 6; ++a) {
    const int i = kVoigtRow[a], j = kVoigtColumn[a];
    C.v[a] = F(0, i) * F(0, j) + F(1, i) * F(1, j) + F(2, i) * F(2, j);
  }
  return C;
}

IsochoricStrain isochoric_strain(const SymPack& C, const LoosePack& J) {
  IsochoricStrain s;
  const Pack root = cbrt(J);
  s.g = 1 / (root * root);
  const Pack inverse_det = 1 / (J * J);
#pragma GCC unroll 6
  for (int a = 0; a < 6; ++a) {
    const int i = kVoigtRow[a], j = kVoigtColumn[a];
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
    s.C_bar.v[a] = s.g * C.v[a];
    s.C_inverse.v[a] = inverse_det * (C(i1, j1) * C(i2, j2) - C(i1, j2) * C(i2, j1));
  }
  return s;
}

void make_isochoric(const IsochoricStrain& strain, bool tangent, LagrangianResponse& r) {
  const auto& [g, C, Ci] = strain;
  const Pack trace = contract(r.S, C);
#pragma GCC unroll 6
  for (int a = 0; a < 6; ++a) r.S.v[a] = g * r.S.v[a] - (trace / 3) * Ci.v[a];
  if (!tangent) return;

  SymPack CC_C;
#pragma GCC unroll 6
  for (int a = 0; a < 6; ++a) {
    const Pack* row = r.CC[a];
    CC_C.v[a] = row[0] * C.v[0] + row[1] * C.v[1] + row[2] * C.v[2] +
                2 * (row[3] * C.v[3] + row[4] * C.v[4] + row[5] * C.v[5]);
  }
  const Pack gg = g * g, third_g = g / 3, third_trace = trace / 3;
  const Pack volume = contract(C, CC_C) / 9 - 2 * trace / 9;
  SymPack v;
#pragma GCC unroll 6
  for (int a = 0; a < 6; ++a) v.v[a] = third_g * CC_C.v[a] + (2.0 / 3) * r.S.v[a] - 0.5 * volume * Ci.v[a];
#pragma GCC unroll 6
  for (int a = 0; a < 6; ++a)
#pragma GCC unroll 6
    for (int b = 0; b <= a; ++b) {
      const int i = kVoigtRow[a], j = kVoigtColumn[a], k = kVoigtRow[b], l = kVoigtColumn[b];
      r.CC[a][b] = gg * r.CC[a][b] - (Ci.v[a] * v.v[b] + v.v[a] * Ci.v[b]) +
                   third_trace * (Ci(i, k) * Ci(j, l) + Ci(i, l) * Ci(j, k));
      r.CC[b][a] = r.CC[a][b];
    }
}

void add_constant_stress(const Mat3Pack& F, const LoosePack& W, const SymPack& S, bool tangent,
                         PackResponse& r) {
  r.W += W;
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
    for (int j = 0; j < 3; ++j) r.P[i + 3 * j] += F(i, 0) * S(0, j) + F(i, 1) * S(1, j) + F(i, 2) * S(2, j);
  if (!tangent) return;
#pragma GCC unroll 9
  for (int a = 0; a < 9; ++a)
#pragma GCC unroll 9
    for (int b = a % 3; b <= a; b += 3) r.A[a][b] += S(a / 3, b / 3);
}

void add_lagrangian(const Mat3Pack& F, const LagrangianResponse& l, bool tangent, PackResponse& r) {
  add_constant_stress(F, l.W, l.S, tangent, r);
  if (!tangent) return;

  Pack D[6][9];  // D_a,kL = F_kN CC_a,NL
#pragma GCC unroll 6
  for (int a = 0; a < 6; ++a)
#pragma GCC unroll 9
    for (int b = 0; b < 9; ++b) {
      const int k = b % 3, L = b / 3;
      D[a][b] =
          F(k, 0) * l.CC[a][kVoigt[0][L]] + F(k, 1) * l.CC[a][kVoigt[1][L]] + F(k, 2) * l.CC[a][kVoigt[2][L]];
    }
#pragma GCC unroll 9
  for (int a = 0; a < 9; ++a)
#pragma GCC unroll 9
    for (int b = 0; b <= a; ++b) {
      const int i = a % 3, J = a / 3;
      r.A[a][b] += F(i, 0) * D[kVoigt[0][J]][b] + F(i, 1) * D[kVoigt[1][J]][b] + F(i, 2) * D[kVoigt[2][J]][b];
    }
}

Mat3Pack to_local_axes(const Mat3Pack& F, const Mat3Pack& R) {
  Mat3Pack product;
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
    for (int j = 0; j < 3; ++j) product(i, j) = F(i, 0) * R(0, j) + F(i, 1) * R(1, j) + F(i, 2) * R(2, j);
  return product;
}

void from_local_axes(const Mat3Pack& R, bool tangent, PackResponse& r) {
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) {
    const Pack p0 = r.P[i], p1 = r.P[i + 3], p2 = r.P[i + 6];
#pragma GCC unroll 3
    for (int J = 0; J < 3; ++J) r.P[i + 3 * J] = p0 * R(J, 0) + p1 * R(J, 1) + p2 * R(J, 2);
  }
  if (!tangent) return;

  Pack half[9][9];  // half_ia,kL = A'_ia,kb R_Lb
#pragma GCC unroll 9
  for (int a = 0; a < 9; ++a)
#pragma GCC unroll 9
    for (int b = 0; b < 9; ++b) {
      const int k = b % 3, L = b / 3;
      const auto entry = [&](int row, int column) -> const Pack& {
        return row >= column ? r.A[row][column] : r.A[column][row];
      };
      half[a][b] = entry(a, k) * R(L, 0) + entry(a, k + 3) * R(L, 1) + entry(a, k + 6) * R(L, 2);
    }
#pragma GCC unroll 9
  for (int a = 0; a < 9; ++a)
#pragma GCC unroll 9
    for (int b = 0; b <= a; ++b) {
      const int i = a % 3, J = a / 3;
      r.A[a][b] = R(J, 0) * half[i][b] + R(J, 1) * half[i + 3][b] + R(J, 2) * half[i + 6][b];
    }
}

}  // namespace polyaffine
