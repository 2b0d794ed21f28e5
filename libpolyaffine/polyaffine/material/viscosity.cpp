#include <algorithm>
#include <utility>

#include <polyaffine/material/lagrangian_response.hpp>
#include <polyaffine/material/viscosity.hpp>

namespace polyaffine {
namespace {

// A Bᵀ
Mat3Pack multiply_transposed(const Mat3Pack& A, const Mat3Pack& B) {
  Mat3Pack product;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) product(i, k) = A(i, 0) * B(k, 0) + A(i, 1) * B(k, 1) + A(i, 2) * B(k, 2);
  return product;
}

// η Ė, with η/2 given.
SymPack viscous_stress(const Pack& half_eta, const Mat3Pack& F, const Mat3Pack& F_dot) {
  SymPack S;
#pragma GCC unroll 6
  for (int a = 0; a < 6; ++a) {
    const int i = kVoigtRow[a], j = kVoigtColumn[a];
    S.v[a] = broadcast(0);
#pragma GCC unroll 3
    for (int m = 0; m < 3; ++m) S.v[a] += half_eta * (F(m, i) * F_dot(m, j) + F_dot(m, i) * F(m, j));
  }
  return S;
}

}  // namespace

KelvinVoigt::KelvinVoigt(double viscosity, std::vector<double> factor)
    : viscosity_(viscosity), factor_(std::move(factor)) {
  require_not_negative("viscosity", viscosity, "kPa ms");
}

void KelvinVoigt::respond(PackPoints points, const PackMotion& at, bool tangent, PackResponse& r) const {
  if (!at.rate) return;
  const Mat3Pack &F = at.F, &F_dot = *at.rate;
  const Pack half_eta = 0.5 * viscosity_ * factor_.at(points);
  add_constant_stress(F, broadcast(0), viscous_stress(half_eta, F, F_dot), false, r);
  if (!tangent) return;
  const Mat3Pack b = multiply_transposed(F, F);
  const Pack scale = at.rate_factor * half_eta;
#pragma GCC unroll 9
  for (int row = 0; row < 9; ++row)
#pragma GCC unroll 9
    for (int column = 0; column <= row; ++column) {
      const int i = row % 3, J = row / 3, k = column % 3, L = column / 3;
      Pack v = F(i, L) * F(k, J);
      if (J == L) v += b(i, k);
      r.A[row][column] += scale * v;
    }
}

void KelvinVoigt::evaluate(int first, int count, const double* F, const double* F_dot, double* P,
                           double* A_dot, double* A) const {
  for (int start = 0; start < count; start += kLanes) {
    const int lanes = std::min(kLanes, count - start);
    const std::ptrdiff_t offset = start;
    const PackPoints points{first + start, lanes};
    const Mat3Pack f = gather_matrix(F + 9 * offset, lanes), rate = gather_matrix(F_dot + 9 * offset, lanes);
    PackResponse r;
    clear(r, A_dot != nullptr);
    respond(points, {f, {}, &rate, 1}, A_dot != nullptr, r);
    if (P) scatter_add_points<9>(P + 9 * offset, lanes, r.P);
    if (A_dot) {
      mirror(r);
      scatter_add_points<81>(A_dot + 81 * offset, lanes, r.A[0]);
    }
    if (!A) continue;
    const Pack half_eta = 0.5 * viscosity_ * factor_.at(points);
    const SymPack S = viscous_stress(half_eta, f, rate);
    const Mat3Pack g = multiply_transposed(f, rate);
    Pack by_F[81];
    for (int column = 0; column < 9; ++column)
      for (int row = 0; row < 9; ++row) {
        const int i = row % 3, J = row / 3, k = column % 3, L = column / 3;
        Pack v = f(i, L) * rate(k, J);
        if (J == L) v += g(i, k);
        by_F[row + 9 * column] = half_eta * v;
        if (i == k) by_F[row + 9 * column] += S(J, L);
      }
    scatter_add_points<81>(A + 81 * offset, lanes, by_F);
  }
}

}  // namespace polyaffine
