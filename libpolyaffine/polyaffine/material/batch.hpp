#pragma once

#include <span>

#include <polyaffine/material/pack.hpp>

namespace polyaffine {

/// One scalar of state per integration point (an active tension in kPa, for instance); empty when there is
/// none.
using PointState = std::span<const double>;

/// The points of one pack: indices point … point + lanes − 1.
struct PackPoints {
  int point;
  int lanes;
};

/// What a law sees of one pack of points.
struct PackMotion {
  const Mat3Pack& F;
  PointState state = {};           ///< of all points
  const Mat3Pack* rate = nullptr;  ///< Ḟ, 1/ms; null where nothing moves
  /// α, 1/ms: the tangent is ∂P/∂F + α ∂P/∂Ḟ.
  double rate_factor = 0;
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

/// Adds W, P and, with `tangent`, the lower triangle of A of `part` to `sum`.
inline void add(const PackResponse& part, bool tangent, PackResponse& sum) {
  sum.W += part.W;
  for (int i = 0; i < 9; ++i) sum.P[i] += part.P[i];
  if (!tangent) return;
  for (int i = 0; i < 9; ++i)
    for (int j = 0; j <= i; ++j) sum.A[i][j] += part.A[i][j];
}

/// Multiplies energy, stress and, with `tangent`, the tangent by a factor per point.
[[gnu::always_inline]] inline void scale(const Pack& factor, bool tangent, PackResponse& r) {
  r.W *= factor;
  for (Pack& p : r.P) p *= factor;
  if (!tangent) return;
  for (int i = 0; i < 9; ++i)
    for (int j = 0; j <= i; ++j) r.A[i][j] *= factor;
}

/// Copies the lower triangle of A to the upper one.
inline void mirror(PackResponse& r) {
  for (int row = 0; row < 9; ++row)
    for (int column = row + 1; column < 9; ++column) r.A[row][column] = r.A[column][row];
}

}  // namespace polyaffine
