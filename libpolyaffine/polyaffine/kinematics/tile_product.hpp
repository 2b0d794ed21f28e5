#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <polyaffine/material/pack.hpp>

namespace polyaffine {

/// C = W Rᵀ for many rows of W, in tiles of C that stay in registers while k runs:
///
///                  k →                          columns of C (functions)
///           ┌───────────────┐                   ┌────┬────┬────┐
///   panel 0 │ row packs 0–2 │        panel 0    │tile│tile│    │   each panel is multiplied only up to
///           ├───────────────┤                   ├────┼────┼────┤   the last column that one of its rows
///   panel 1 │ row packs 3–5 │        panel 1    │tile│tile│tile│   needs (need_column)
///           └───────────────┘ W                 └────┴────┴────┘ C
///
/// A row pack is kLanes rows side by side. A panel stores, for every k, its kTileRows row packs in a row. W
/// and R come in chunks of k: start_chunk, fill the rows, multiply.
class TileProduct {
 public:
  /// Starts a product of zero, with room for so many row packs and columns; memory of former ones is used
  /// again.
  void start(int row_packs, int columns) {
    panels_ = (row_packs + kTileRows - 1) / kTileRows;
    column_tiles_ = (columns + kTileColumns - 1) / kTileColumns;
    last_.assign(panels_, 0);
    offset_.resize(row_packs);
    tiles_.assign(static_cast<std::size_t>(panels_) * column_tiles_ * kTile, 0.0);
  }

  /// C is needed in this row pack up to this column at least.
  void need_column(int row_pack, int column) {
    int& last = last_[row_pack / kTileRows];
    last = std::max(last, column / kTileColumns);
  }

  /// Room for the rows at `depth` values of k.
  void start_chunk(int depth) {
    depth_ = depth;
    W_.resize(static_cast<std::size_t>(panels_) * depth * kTileRows * kLanes);
    for (int s = 0; s < std::ssize(offset_); ++s)
      offset_[s] = ((s / kTileRows) * depth * kTileRows + s % kTileRows) * kLanes;
  }
  /// Where the kLanes numbers of a row pack at the k-th value of the chunk are to be written.
  double* row(int row_pack, int k) { return W_.data() + offset_[row_pack] + k * kTileRows * kLanes; }
  /// Adds the chunk. R has `stride` numbers for every k, of which the first columns count; it is padded to
  /// whole tiles.
  void multiply(const double* R, std::ptrdiff_t stride) {
    for (int panel = 0; panel < panels_; ++panel)
      for (int tile = 0; tile <= last_[panel]; ++tile)
        multiply_tile(row(panel * kTileRows, 0), R + tile * kTileColumns, stride,
                      tiles_.data() + (static_cast<std::ptrdiff_t>(panel) * column_tiles_ + tile) * kTile);
  }

  /// The kLanes numbers of C of a row pack.
  const double* entries(int row_pack, int column) const {
    const int panel = row_pack / kTileRows, place = row_pack % kTileRows;
    const std::ptrdiff_t tile = static_cast<std::ptrdiff_t>(panel) * column_tiles_ + column / kTileColumns;
    return tiles_.data() + tile * kTile + ((column % kTileColumns) * kTileRows + place) * kLanes;
  }

 private:
  // Twelve sums, three factors from W and one from R fill the sixteen vector registers of AVX2.
  static constexpr int kTileRows = 3;  // packs
  static constexpr int kTileColumns = 4;
  static constexpr int kTile = kTileRows * kTileColumns * kLanes;

  // C += W Rᵀ of one tile.
  void multiply_tile(const double* W, const double* R, std::ptrdiff_t stride, double* C) const {
    Pack c[kTileColumns][kTileRows];
#pragma GCC unroll 4
    for (int b = 0; b < kTileColumns; ++b)
#pragma GCC unroll 3
      for (int a = 0; a < kTileRows; ++a) c[b][a] = load(C + (b * kTileRows + a) * kLanes);
    for (int k = 0; k < depth_; ++k, W += kTileRows * kLanes, R += stride) {
      Pack w[kTileRows];
#pragma GCC unroll 3
      for (int a = 0; a < kTileRows; ++a) w[a] = load(W + a * kLanes);
#pragma GCC unroll 4
      for (int b = 0; b < kTileColumns; ++b) {
        const Pack r = broadcast(R[b]);
#pragma GCC unroll 3
        for (int a = 0; a < kTileRows; ++a) c[b][a] += w[a] * r;
      }
    }
#pragma GCC unroll 4
    for (int b = 0; b < kTileColumns; ++b)
#pragma GCC unroll 3
      for (int a = 0; a < kTileRows; ++a) store(C + (b * kTileRows + a) * kLanes, c[b][a]);
  }

  int panels_ = 0, column_tiles_ = 0, depth_ = 0;
  std::vector<int> last_;    // column tile that each panel needs
  std::vector<int> offset_;  // of each row pack at k = 0 in W_
  std::vector<double> W_, tiles_;
};

}  // namespace polyaffine
