#include <algorithm>
#include <utility>

#include <polyaffine/material/lagrangian_response.hpp>
#include <polyaffine/material/viscosity.hpp>

namespace polyaffine {
namespace {

Mat3Pack gather_matrix(const double* data, int lanes) {
  Mat3Pack m;
  for (int i = 0; i < 9; ++i) m.m[i] = gather(data + i, 9, lanes);
  return m;
}

// A Bᵀ
Mat3Pack multiply_transposed(const Mat3Pack& A, const Mat3Pack& B) {
  Mat3Pack product;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) product(i, k) = A(i, 0) * B(k, 0) + A(i, 1) * B(k, 1) + A(i, 2) * B(k, 2);
  return product;
}

}  // namespace

KelvinVoigt::KelvinVoigt(double viscosity, std::vector<double> factor)
    : viscosity_(viscosity), factor_(std::move(factor)) {
  require_not_negative("viscosity", viscosity, "kPa ms");
}

void KelvinVoigt::evaluate(int first, int count, const double* F, const double* F_dot, double* P,
                           double* A_dot, double* A) const {
  for (int start = 0; start < count; start += kLanes) {
    const int lanes = std::min(kLanes, count - start);
    const std::ptrdiff_t offset = start;
    const Mat3Pack f = gather_matrix(F + 9 * offset, lanes), rate = gather_matrix(F_dot + 9 * offset, lanes);
    const Pack half_eta = 0.5 * viscosity_ * factor_.at({first + start, lanes});

    SymPack S;
    for (int a = 0; a < 6; ++a) {
      const int i = kVoigtRow[a], j = kVoigtColumn[a];
      S.v[a] = broadcast(0);
      for (int m = 0; m < 3; ++m) S.v[a] += half_eta * (f(m, i) * rate(m, j) + rate(m, i) * f(m, j));
    }
    PackResponse r;
    clear(r, false);
    add_constant_stress(f, broadcast(0), S, false, r);
    if (P) scatter_add_points<9>(P + 9 * offset, lanes, r.P);
    if (!A_dot && !A) continue;

    const Mat3Pack b = multiply_transposed(f, f), g = multiply_transposed(f, rate);
    Pack by_rate[81], by_F[81];
    for (int column = 0; column < 9; ++column)
      for (int row = 0; row < 9; ++row) {
        const int i = row % 3, J = row / 3, k = column % 3, L = column / 3;
        Pack v_dot = f(i, L) * f(k, J), v = f(i, L) * rate(k, J);
        if (J == L) {
          v_dot += b(i, k);
          v += g(i, k);
        }
        by_rate[row + 9 * column] = half_eta * v_dot;
        by_F[row + 9 * column] = half_eta * v;
        if (i == k) by_F[row + 9 * column] += S(J, L);
      }
    if (A_dot) scatter_add_points<81>(A_dot + 81 * offset, lanes, by_rate);
    if (A) scatter_add_points<81>(A + 81 * offset, lanes, by_F);
  }
}

}  // namespace polyaffine
