#include "polyaffine/kinematics/block_products.hpp"

#include <algorithm>
#include <iterator>

namespace polyaffine {
namespace {

using Group = PackedBlock::Group;

constexpr int kTileRows = 3;  // packs
constexpr int kTileColumns = 4;
constexpr int kChunkPacks =
    4;  // points of so many packs are multiplied at once: their rows stay in the cache

// C += W Rᵀ of many rows: row pack s of W belongs to panel s / kTileRows, and a panel stores, for every k,
// its kTileRows packs side by side. Each panel is multiplied with the functions before its own last column.
class TileProduct {
 public:
  // Starts a product; memory of former ones is used again.
  void start(int row_packs, int columns) {
    panels_ = (row_packs + kTileRows - 1) / kTileRows;
    column_tiles_ = (columns + kTileColumns - 1) / kTileColumns;
    last_.assign(panels_, 0);
    offset_.resize(row_packs);
    tiles_.assign(static_cast<std::size_t>(panels_) * column_tiles_ * kTile, 0.0);
  }

  void need_column(int row_pack, int column) {
    int& last = last_[row_pack / kTileRows];
    last = std::max(last, column / kTileColumns);
  }

  // Room for the rows at `depth` values of k.
  void start_chunk(int depth) {
    depth_ = depth;
    W_.resize(static_cast<std::size_t>(panels_) * depth * kTileRows * kLanes);
    for (int s = 0; s < std::ssize(offset_); ++s)
      offset_[s] = ((s / kTileRows) * depth * kTileRows + s % kTileRows) * kLanes;
  }
  double* row(int row_pack, int k) { return W_.data() + offset_[row_pack] + k * kTileRows * kLanes; }
  // R: `stride` numbers a k, of which the first columns are multiplied; padded to whole column tiles.
  void multiply(const double* R, std::ptrdiff_t stride) {
    for (int panel = 0; panel < panels_; ++panel)
      for (int tile = 0; tile <= last_[panel]; ++tile)
        multiply_tile(row(panel * kTileRows, 0), R + tile * kTileColumns, stride,
                      tiles_.data() + (static_cast<std::ptrdiff_t>(panel) * column_tiles_ + tile) * kTile);
  }

  // The kLanes numbers of C of a row pack.
  const double* entries(int row_pack, int column) const {
    const int panel = row_pack / kTileRows, place = row_pack % kTileRows;
    const std::ptrdiff_t tile = static_cast<std::ptrdiff_t>(panel) * column_tiles_ + column / kTileColumns;
    return tiles_.data() + tile * kTile + ((column % kTileColumns) * kTileRows + place) * kLanes;
  }

 private:
  static constexpr int kTile = kTileRows * kTileColumns * kLanes;

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
  std::vector<int> last_, offset_;
  std::vector<double> W_, tiles_;
};

// One a thread: blocks are many and small.
TileProduct& workspace() {
  thread_local TileProduct product;
  return product;
}

struct Component {
  int i, j;
};

// Y = LᵀX at one pack for 9×n X and 3d×n Y; entry (i, c) of X has index i x.row + c x.column.
struct Strides {
  int row, column;
};
void pull_back_columns(const Group& g, int pack, const Pack* X, Strides x, int columns, Pack* Y, Strides y) {
  for (int e = 0; e < g.d; ++e)
    for (int k = 0; k < 3; ++k) {
      const int row = k + 3 * e;
      if (!g.lifted) {
        for (int c = 0; c < columns; ++c) Y[row * y.row + c * y.column] = X[row * x.row + c * x.column];
        continue;
      }
      for (int c = 0; c < columns; ++c) Y[row * y.row + c * y.column] = Pack{};
      for (int J = 0; J < 3; ++J) {
        if (g.place[J][e] < 0) continue;
        const double* L = g.lift_block(pack, J, e) + static_cast<std::ptrdiff_t>(3 * k * kLanes);
        const Pack l[3] = {load(L), load(L + kLanes), load(L + 2 * kLanes)};
        const Pack* from = X + 3 * J * x.row;
        for (int c = 0; c < columns; ++c, from += x.column)
          Y[row * y.row + c * y.column] += l[0] * from[0] + l[1] * from[x.row] + l[2] * from[2 * x.row];
      }
    }
}

// T = L_gᵀ A L_h at one pack, 3d_g × 3d_h, row r and column c at index r + 3 d_g c; A with both triangles.
void pull_back_tangent(const Group& g, const Group& h, int pack, const PackResponse& r, Pack* T) {
  Pack half[12 * 9];  // L_hᵀA, 3d_h × 9
  pull_back_columns(h, pack, r.A[0], {1, 9}, 9, half, {9, 1});
  pull_back_columns(g, pack, half, {1, 9}, 3 * h.d, T, {1, 3 * g.d});
}

// Writes, for the points of pack `pack` (the `slot`-th of the chunk), rows(g) · T_ij of every component.
template <int d>
void fill_rows(const Group& g, int d_h, int pack, int slot, const std::vector<Component>& components,
               const double* T, TileProduct& product) {
  const int packs = g.padded / kLanes;
  for (int lane = 0; lane < kLanes; ++lane) {
    const double* rows =
        g.by_point.data() + static_cast<std::ptrdiff_t>(g.padded) * d * (kLanes * pack + lane);
    for (std::size_t s = 0; s < components.size(); ++s)
      for (int e = 0; e < d_h; ++e) {
        Pack t[d];
#pragma GCC unroll 4
        for (int f = 0; f < d; ++f)
          t[f] = broadcast(T[(components[s].i + 3 * f + 3 * d * (components[s].j + 3 * e)) * kLanes + lane]);
        for (int a = 0; a < packs; ++a) {
          Pack out = t[0] * load(rows + a * kLanes);
#pragma GCC unroll 3
          for (int f = 1; f < d; ++f) out += t[f] * load(rows + (f * packs + a) * kLanes);
          store(product.row(static_cast<int>(s) * packs + a, (kLanes * slot + lane) * d_h + e), out);
        }
      }
  }
}

void add_groups(const PackedBlock& block, const Group& g, const Group& h, int row0, int col0,
                const PackResponse* responses, Matrix& K) {
  const bool same = &g == &h;
  std::vector<Component> components;
  for (int i = 0; i < 3; ++i)
    for (int j = same ? i : 0; j < 3; ++j) components.push_back({i, j});
  const int packs = g.padded / kLanes;
  const auto symmetric = [&](const Component& c) { return same && c.i == c.j; };
  TileProduct& product = workspace();
  product.start(packs * static_cast<int>(components.size()), h.padded);
  for (std::size_t s = 0; s < components.size(); ++s)
    for (int a = 0; a < packs; ++a)
      product.need_column(static_cast<int>(s) * packs + a,
                          symmetric(components[s]) ? kLanes * a + kLanes - 1 : h.num_functions - 1);

  Pack T[12 * 12];
  for (int begin = 0; begin < block.num_packs(); begin += kChunkPacks) {
    const int count = std::min(kChunkPacks, block.num_packs() - begin);
    product.start_chunk(count * kLanes * h.d);
    for (int slot = 0; slot < count; ++slot) {
      pull_back_tangent(g, h, begin + slot, responses[begin + slot], T);
      (g.d == 4 ? fill_rows<4> : fill_rows<3>)(g, h.d, begin + slot, slot, components,
                                               reinterpret_cast<const double*>(T), product);
    }
    product.multiply(h.by_point.data() + static_cast<std::ptrdiff_t>(h.padded) * h.d * kLanes * begin,
                     h.padded);
  }

  for (std::size_t s = 0; s < components.size(); ++s) {
    const auto [i, j] = components[s];
    for (int b = 0; b < h.num_functions; ++b)
      for (int pack = symmetric(components[s]) ? b / kLanes : 0; pack < packs; ++pack) {
        const double* v = product.entries(static_cast<int>(s) * packs + pack, b);
        const int first = kLanes * pack, last = std::min(first + kLanes, g.num_functions);
        for (int a = symmetric(components[s]) ? std::max(first, b) : first; a < last; ++a) {
          K(row0 + 3 * a + i, col0 + 3 * b + j) = v[a - first];
          K(col0 + 3 * b + j, row0 + 3 * a + i) = v[a - first];
        }
      }
  }
}

}  // namespace

void block_stiffness(const PackedBlock& block, const PackResponse* responses, Matrix& K) {
  const auto n = static_cast<Eigen::Index>(3 * block.functions().size());
  K.resize(n, n);
  int row0 = 0;
  for (const auto& g : block.groups()) {
    int col0 = row0;
    for (const Group* h = &g; h != block.groups().data() + block.groups().size(); ++h) {
      add_groups(block, g, *h, row0, col0, responses, K);
      col0 += 3 * h->num_functions;
    }
    row0 += 3 * g.num_functions;
  }
}

void block_force_rows(const PackedBlock& block, const Mat3Pack* S, const Matrix& values, Matrix& rows) {
  const auto n = static_cast<int>(values.rows());
  const int packs = (n + kLanes - 1) / kLanes;
  rows.resize(n, static_cast<Eigen::Index>(3 * block.functions().size()));
  Matrix padded = Matrix::Zero(packs * kLanes, kLanes * block.num_packs());
  padded.topLeftCorner(n, values.cols()) = values;
  int first = 0;
  for (const auto& g : block.groups()) {
    TileProduct& product = workspace();
    product.start(3 * packs, g.padded);
    for (int s = 0; s < 3 * packs; ++s) product.need_column(s, g.num_functions - 1);
    Pack Y[12];
    for (int begin = 0; begin < block.num_packs(); begin += kChunkPacks) {
      const int count = std::min(kChunkPacks, block.num_packs() - begin);
      product.start_chunk(count * kLanes * g.d);
      for (int slot = 0; slot < count; ++slot) {
        pull_back(g, begin + slot, S[begin + slot], Y);
        for (int lane = 0; lane < kLanes; ++lane) {
          const double* at = padded.col(kLanes * (begin + slot) + lane).data();
          for (int e = 0; e < g.d; ++e)
            for (int i = 0; i < 3; ++i) {
              const Pack y = broadcast(Y[i + 3 * e][lane]);
              for (int b = 0; b < packs; ++b)
                store(product.row(i * packs + b, (kLanes * slot + lane) * g.d + e),
                      y * load(at + b * kLanes));
            }
        }
      }
      product.multiply(g.by_point.data() + static_cast<std::ptrdiff_t>(g.padded) * g.d * kLanes * begin,
                       g.padded);
    }
    for (int a = 0; a < g.num_functions; ++a)
      for (int i = 0; i < 3; ++i)
        for (int b = 0; b < n; ++b)
          rows(b, first + 3 * a + i) = product.entries(i * packs + b / kLanes, a)[b % kLanes];
    first += 3 * g.num_functions;
  }
}

}  // namespace polyaffine
