#pragma once

#include <algorithm>

#include <polyaffine/material/pack.hpp>

namespace polyaffine {

/// The points of one pack: indices point … point + lanes − 1.
struct PackPoints {
  int point;
  int lanes;
};

/// Energy, stress and tangent of one pack of points. Entry iJ of a 3×3 matrix has index i + 3J; of the
/// symmetric A only the lower triangle A[row][column], row ≥ column, is used.
struct PackResponse {
  Pack W;
  Pack P[9];
  Pack A[9][9];
};

/// Sets W, P and, with `tangent`, A to zero.
inline void clear(PackResponse& r, bool tangent) {
  r.W = broadcast(0);
  for (Pack& p : r.P) p = broadcast(0);
  if (!tangent) return;
  for (auto& row : r.A)
#pragma GCC unroll 9
    for (Pack& a : row) a = broadcast(0);
}

/// The loop of every law: walks over the points of Law::evaluate pack by pack, lets
/// `kernel(PackPoints, const Mat3Pack& F, bool tangent, PackResponse& cleared)` fill in the response and adds
/// it to the outputs that are not null. Without `tangent` the kernel may leave A alone.
template <class Kernel>
void evaluate_packed(int first, int count, const double* F, double* W, double* P, double* A,
                     const Kernel& kernel) {
  for (int start = 0; start < count; start += kLanes) {
    const int lanes = std::min(kLanes, count - start);
    const std::ptrdiff_t offset = start;
    Mat3Pack pack;
    for (int i = 0; i < 9; ++i) pack.m[i] = gather(F + 9 * offset + i, 9, lanes);
    PackResponse r;
    clear(r, A != nullptr);
    kernel(PackPoints{first + start, lanes}, pack, A != nullptr, r);
    if (W) scatter_add(W + offset, 1, lanes, r.W);
    if (P) scatter_add_points<9>(P + 9 * offset, lanes, r.P);
    if (A) {
      for (int row = 0; row < 9; ++row)
        for (int column = row + 1; column < 9; ++column) r.A[row][column] = r.A[column][row];
      scatter_add_points<81>(A + 81 * offset, lanes, r.A[0]);
    }
  }
}

/// Multiplies energy, stress and, with `tangent`, the tangent by a factor per point.
inline void scale(const Pack& factor, bool tangent, PackResponse& r) {
  r.W *= factor;
  for (Pack& p : r.P) p *= factor;
  if (!tangent) return;
  for (int i = 0; i < 9; ++i)
    for (int j = 0; j <= i; ++j) r.A[i][j] *= factor;
}

}  // namespace polyaffine
