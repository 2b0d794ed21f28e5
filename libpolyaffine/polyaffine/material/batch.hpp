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

/// The loop of every law: walks over the points of Law::evaluate pack by pack, lets
/// `kernel(PackPoints, const Mat3Pack& F, bool tangent, PackResponse& zeroed)` fill in the response and adds
/// it to the outputs that are not null. Without `tangent` the kernel may leave A alone.
template <class Kernel>
void evaluate_packed(int first, int count, const double* F, double* W, double* P, double* A,
                     const Kernel& kernel) {
  for (int start = 0; start < count; start += kLanes) {
    const int lanes = std::min(kLanes, count - start);
    Mat3Pack pack;
    for (int i = 0; i < 9; ++i) pack.m[i] = gather(F + 9 * start + i, 9, lanes);
    PackResponse r{};
    kernel(PackPoints{first + start, lanes}, pack, A != nullptr, r);
    if (W) scatter_add(W + start, 1, lanes, r.W);
    if (P)
      for (int i = 0; i < 9; ++i) scatter_add(P + 9 * start + i, 9, lanes, r.P[i]);
    if (A)
      for (int j = 0; j < 9; ++j)
        for (int i = 0; i < 9; ++i)
          scatter_add(A + 81 * start + i + 9 * j, 81, lanes, i >= j ? r.A[i][j] : r.A[j][i]);
  }
}

/// Multiplies energy, stress and tangent by a factor per point.
inline void scale(PackResponse& r, const Pack& factor) {
  r.W *= factor;
  for (Pack& p : r.P) p *= factor;
  for (int i = 0; i < 9; ++i)
    for (int j = 0; j <= i; ++j) r.A[i][j] *= factor;
}

}  // namespace polyaffine
