#pragma once

#include <polyaffine/material/batch.hpp>

namespace polyaffine {

/// Cofactor matrix cof F = ∂(det F)/∂F.
inline Mat3Pack cofactor(const Mat3Pack& F) {
  Mat3Pack H;
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
    for (int j = 0; j < 3; ++j) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      H(i, j) = F(i1, j1) * F(i2, j2) - F(i1, j2) * F(i2, j1);
    }
  return H;
}

[[gnu::always_inline]] inline Pack determinant(const Mat3Pack& F, const Mat3Pack& cof) {
  return F.m[0] * cof.m[0] + F.m[1] * cof.m[1] + F.m[2] * cof.m[2];
}

/// A function U of J = det F with its two derivatives.
struct VolumeFunction {
  Pack U, dU, ddU;
};

/// Adds W = U(J), P = U' cof F, A = U'' cof F ⊗ cof F + U' ∂cof F/∂F with
/// ∂(cof F)_iJ/∂F_kL = ε_ikm ε_JLM F_mM.
inline void add_volumetric(const Mat3Pack& F, const Mat3Pack& cof, const VolumeFunction& f, bool tangent,
                           PackResponse& r) {
  r.W += f.U;
#pragma GCC unroll 9
  for (int a = 0; a < 9; ++a) r.P[a] += f.dU * cof.m[a];
  if (!tangent) return;
#pragma GCC unroll 9
  for (int a = 0; a < 9; ++a)
#pragma GCC unroll 9
    for (int b = 0; b <= a; ++b) {
      r.A[a][b] += f.ddU * cof.m[a] * cof.m[b];
      const int i = a % 3, j = a / 3, k = b % 3, l = b / 3;
      if (i == k || j == l) continue;
      const bool even = ((k - i + 3) % 3 == 1) == ((l - j + 3) % 3 == 1);
      const Pack& entry = F(3 - i - k, 3 - j - l);
      r.A[a][b] += even ? f.dU * entry : -f.dU * entry;
    }
}

}  // namespace polyaffine
