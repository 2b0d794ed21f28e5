#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

// A function that returns a Pack by value would leave it in a register or in memory, as the flags of its
// compilation say. Here all of them are always inlined, so that no such call exists; compilers warn all the
// same, where they are used, so that the warning stays off behind this header.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace polyaffine {

inline constexpr int kLanes = 4;

/// The same number of `kLanes` points side by side: one AVX register, two SSE registers. Size and alignment
/// (32 bytes) are the same whatever the processor flags, so that code compiled with other flags than the
/// library's may hold packs and hand them over in structures; a function that is not always inlined must not
/// return a bare Pack, and takes one as `const LoosePack&`.
using Pack = double __attribute__((vector_size(8 * kLanes), aligned(8 * kLanes)));

/// A pack as the result of an expression, which without AVX is aligned to 16 bytes only.
using LoosePack = double __attribute__((vector_size(8 * kLanes), aligned(16)));

/// `kLanes` 3×3 matrices, column-major like the arrays of a Law.
struct Mat3Pack {
  Pack m[9];
  Pack& operator()(int row, int column) { return m[row + 3 * column]; }
  const Pack& operator()(int row, int column) const { return m[row + 3 * column]; }
};

/// kLanes neighbouring numbers in memory, at any address.
[[gnu::always_inline]] inline Pack load(const double* data) {
  Pack v;
  std::memcpy(&v, data, sizeof v);
  return v;
}
[[gnu::always_inline]] inline void store(double* data, const Pack& v) {
  std::memcpy(data, &v, sizeof v);
}

/// Reads base[0], base[stride], … one per lane. Lanes from `lanes` on repeat the last valid one, so that the
/// end of a batch computes on ordinary numbers.
[[gnu::always_inline]] inline Pack gather(const double* base, std::ptrdiff_t stride, int lanes) {
  if (stride == 1 && lanes == kLanes) return load(base);
  Pack v;
  for (int lane = 0; lane < kLanes; ++lane) v[lane] = base[stride * (lane < lanes ? lane : lanes - 1)];
  return v;
}

/// The 3×3 matrices of the points of a pack, nine numbers a point, points one after the other.
inline Mat3Pack gather_matrix(const double* base, int lanes) {
  Mat3Pack m;
  for (int i = 0; i < 9; ++i) m.m[i] = gather(base + i, 9, lanes);
  return m;
}

/// Adds lane l of `v` to base[l · stride] for the first `lanes` lanes.
[[gnu::always_inline]] inline void scatter_add(double* base, std::ptrdiff_t stride, int lanes,
                                               const Pack& v) {
  for (int lane = 0; lane < lanes; ++lane) base[stride * lane] += v[lane];
}

/// Adds entry i of every point, v[i][lane], to base[size · lane + i]: `size` numbers a point, points one
/// after the other. Full packs go through a transposition in registers.
template <std::ptrdiff_t size>
void scatter_add_points(double* base, int lanes, const Pack* v) {
  std::ptrdiff_t i = 0;
  const auto add = [base](std::ptrdiff_t lane, std::ptrdiff_t entry, const LoosePack& more) {
    double* at = base + size * lane + entry;
    store(at, load(at) + more);
  };
  if (lanes == kLanes)
    for (; i + 4 <= size; i += 4) {
      const Pack a = __builtin_shufflevector(v[i], v[i + 1], 0, 4, 2, 6);
      const Pack b = __builtin_shufflevector(v[i], v[i + 1], 1, 5, 3, 7);
      const Pack c = __builtin_shufflevector(v[i + 2], v[i + 3], 0, 4, 2, 6);
      const Pack d = __builtin_shufflevector(v[i + 2], v[i + 3], 1, 5, 3, 7);
      add(0, i, __builtin_shufflevector(a, c, 0, 1, 4, 5));
      add(1, i, __builtin_shufflevector(b, d, 0, 1, 4, 5));
      add(2, i, __builtin_shufflevector(a, c, 2, 3, 6, 7));
      add(3, i, __builtin_shufflevector(b, d, 2, 3, 6, 7));
    }
  for (; i < size; ++i) scatter_add(base + i, size, lanes, v[i]);
}

[[gnu::always_inline]] inline Pack broadcast(double value) {
  return value - Pack{};  // a sum with zero would be computed, for the sake of −0
}

/// Sum of the lanes, in their order.
[[gnu::always_inline]] inline double sum(const Pack& v) {
  double s = v[0];
  for (int lane = 1; lane < kLanes; ++lane) s += v[lane];
  return s;
}

/// e^x to about 1 ulp: x = n ln 2 + r, |r| ≤ ln 2 / 2, Taylor polynomial of degree 13 for e^r (remainder
/// below 5·10⁻¹⁸). Below x = −708 the result stays at e^−708, above 709.4 it is infinite.
[[gnu::always_inline]] inline Pack exp(const Pack& argument) {
  using Bits = std::int64_t __attribute__((vector_size(8 * kLanes)));
  constexpr double kRound =
      6755399441055744.0;  // 1.5·2⁵²: adding it leaves the nearest integer in the low bits
  const Pack lowest = broadcast(-708), highest = broadcast(710);
  Pack x = argument < lowest ? lowest : argument;
  x = x > highest ? highest : x;
  const Pack shifted = x * 1.4426950408889634 + kRound;
  const Pack n = shifted - kRound;
  const Pack r = (x - n * 6.93147180369123816490e-01) - n * 1.90821492927058770002e-10;
  constexpr double kInverseFactorial[] = {
      1.0 / 6227020800, 1.0 / 479001600, 1.0 / 39916800, 1.0 / 3628800, 1.0 / 362880, 1.0 / 40320, 1.0 / 5040,
      1.0 / 720,        1.0 / 120,       1.0 / 24,       1.0 / 6,       0.5,          1.0,         1.0};
  Pack sum = broadcast(kInverseFactorial[0]);
#pragma GCC unroll 13
  for (int k = 1; k < 14; ++k) sum = sum * r + kInverseFactorial[k];
  const Bits exponent = ((Bits)shifted - (Bits)broadcast(kRound) + 1023) << 52;
  return sum * (Pack)exponent;
}

[[gnu::always_inline]] inline Pack log(const Pack& x) {
  Pack y;
  for (int lane = 0; lane < kLanes; ++lane) y[lane] = std::log(x[lane]);
  return y;
}

/// ∛x to about 1 ulp for x > 0 (meaningless elsewhere): a third of the exponent bits gives y to 5 %, and
/// three steps of Halley's iteration cube the error each.
[[gnu::always_inline]] inline Pack cbrt(const Pack& x) {
  Pack y;
  for (int lane = 0; lane < kLanes; ++lane)
    y[lane] = std::bit_cast<double>(std::bit_cast<std::uint64_t>(x[lane]) / 3 + 0x2A9F7893782DA1CEULL);
#pragma GCC unroll 3
  for (int k = 0; k < 3; ++k) {
    const Pack cube = y * y * y;
    y = y - y * (cube - x) / (cube + (cube + x));
  }
  return y;
}

}  // namespace polyaffine
