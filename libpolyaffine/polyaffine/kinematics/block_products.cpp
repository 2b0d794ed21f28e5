#include "polyaffine/kinematics/block_products.hpp"

#include <algorithm>

#include <polyaffine/kinematics/tile_product.hpp>

namespace polyaffine {
namespace {

using Group = PackedBlock::Group;

// The points of this many packs are multiplied at once: their rows stay in the cache of the first level.
constexpr int kChunkPacks = 4;

// Most numbers that a group's coordinates vec(3×d) take: d ≤ 4 (of modes nine).
constexpr int kMostCoordinates = 12;

// One a thread, because blocks are many and small: its memory is used again.
TileProduct& workspace() {
  thread_local TileProduct product;
  return product;
}

// Where entry (row, column) of a matrix of packs stands: row · row_stride + column · column_stride.
struct Strides {
  int row, column;
};

// Y = LᵀX at one pack, for X 9 × columns and Y 3d × columns. The block (J, e) of the lift L, 3 × 3, leads
// from column e of the group's coordinates to column J of the field.
void pull_back_columns(const Group& g, int pack, const Pack* X, Strides x, int columns, Pack* Y, Strides y) {
  if (!g.lifted) {
    for (int row = 0; row < 9; ++row)
      for (int c = 0; c < columns; ++c) Y[row * y.row + c * y.column] = X[row * x.row + c * x.column];
    return;
  }
  for (int e = 0; e < g.d; ++e)
    for (int k = 0; k < 3; ++k) {
      const int row = k + 3 * e;
      for (int c = 0; c < columns; ++c) Y[row * y.row + c * y.column] = Pack{};
      for (int J = 0; J < 3; ++J) {
        if (g.place[J][e] < 0) continue;  // a block of zeros
        const double* L = g.lift_block(pack, J, e) + static_cast<std::ptrdiff_t>(3 * k * kLanes);
        const Pack l[3] = {load(L), load(L + kLanes), load(L + 2 * kLanes)};
        const Pack* from = X + 3 * J * x.row;
        for (int c = 0; c < columns; ++c, from += x.column)
          Y[row * y.row + c * y.column] += l[0] * from[0] + l[1] * from[x.row] + l[2] * from[2 * x.row];
      }
    }
}

// Numbers of the coordinates of a group: vec(3×d), or the nine of modes.
int coordinates(const Group& g) {
  return g.components * g.d;
}

// T = L_gᵀ A L_h at one pack, a column a coordinate of h; A with both triangles.
void pull_back_tangent(const Group& g, const Group& h, int pack, const PackResponse& r, Pack* T) {
  Pack half[kMostCoordinates * 9];  // L_hᵀ A, by rows of nine
  pull_back_columns(h, pack, r.A[0], {1, 9}, 9, half, {9, 1});
  pull_back_columns(g, pack, half, {1, 9}, coordinates(h), T, {1, coordinates(g)});
}

// The stiffness between the functions a of group g and b of group h, whose points q carry rows r_f(a, q) and
// r_e(b, q), is a product of matrices for each pair (i, j) of components of the displacement:
//
//     K(a i, b j) = Σ_q Σ_f Σ_e r_f(a, q) T_q(i + 3f, j + 3e) r_e(b, q) = Σ_k W_ij(a, k) R(b, k),  k = (q,
//     e), W_ij(a, k)  = Σ_f r_f(a, q) T_q(i + 3f, j + 3e),        R(b, k) = r_e(b, q).
//
// The W_ij of all pairs stand below each other as the rows of one TileProduct: functions a of pair s in the
// row packs s · packs and on. Modes have one component (i or j = 0), and f or e runs over nine numbers.
class GroupStiffness {
 public:
  GroupStiffness(const PackedBlock& block, const Group& g, const Group& h)
      : block_(block), g_(g), h_(h), same_(&g == &h), packs_(g.padded / kLanes) {
    // K is symmetric: within one group the pairs with i > j are those with i < j mirrored.
    for (int i = 0; i < g.components; ++i)
      for (int j = same_ ? i : 0; j < h.components; ++j) pairs_.push_back({i, j});
  }

  // W Rᵀ for the tangents of the block's packs.
  void multiply(const PackResponse* responses, TileProduct& product) const {
    product.start(packs_ * num_pairs(), h_.padded);
    for (int s = 0; s < num_pairs(); ++s)
      for (int a = 0; a < packs_; ++a)
        product.need_column(s * packs_ + a,
                            is_symmetric(pairs_[s]) ? kLanes * a + kLanes - 1 : h_.num_functions - 1);
    Pack T[kMostCoordinates * kMostCoordinates];
    for (int begin = 0; begin < block_.num_packs(); begin += kChunkPacks) {
      const int count = std::min(kChunkPacks, block_.num_packs() - begin);
      product.start_chunk(count * kLanes * h_.d);
      for (int slot = 0; slot < count; ++slot) {
        pull_back_tangent(g_, h_, begin + slot, responses[begin + slot], T);
        const auto* numbers = reinterpret_cast<const double*>(T);
        if (g_.components == 1)
          fill_rows<1, 9>(begin + slot, slot, numbers, product);
        else if (g_.d == 4)
          fill_rows<3, 4>(begin + slot, slot, numbers, product);
        else
          fill_rows<3, 3>(begin + slot, slot, numbers, product);
      }
      product.multiply(h_.by_point.data() + static_cast<std::ptrdiff_t>(h_.padded) * h_.d * kLanes * begin,
                       h_.padded);
    }
  }

  // Writes the product and its mirror image to the rows and columns of the two groups in K.
  void write(const TileProduct& product, int row0, int col0, Matrix& K) const {
    for (int s = 0; s < num_pairs(); ++s) {
      const auto [i, j] = pairs_[s];
      const bool symmetric = is_symmetric(pairs_[s]);
      for (int b = 0; b < h_.num_functions; ++b)
        for (int pack = symmetric ? b / kLanes : 0; pack < packs_; ++pack) {
          const double* v = product.entries(s * packs_ + pack, b);
          const int first = kLanes * pack, last = std::min(first + kLanes, g_.num_functions);
          for (int a = symmetric ? std::max(first, b) : first; a < last; ++a) {
            const int row = row0 + g_.components * a + i, col = col0 + h_.components * b + j;
            K(row, col) = K(col, row) = v[a - first];
          }
        }
    }
  }

 private:
  struct Pair {
    int i, j;
  };
  int num_pairs() const { return static_cast<int>(pairs_.size()); }
  // W_ij Rᵀ is symmetric itself, so that a ≥ b is enough.
  bool is_symmetric(const Pair& pair) const { return same_ && pair.i == pair.j; }

  // Writes W_ij of every pair at the points of pack `pack`, the `slot`-th of the chunk.
  template <int components, int d>
  void fill_rows(int pack, int slot, const double* T, TileProduct& product) const {
    const int packs = packs_;  // stores could change the member, for all the compiler knows
    for (int lane = 0; lane < kLanes; ++lane) {
      const double* rows =
          g_.by_point.data() + static_cast<std::ptrdiff_t>(g_.padded) * d * (kLanes * pack + lane);
      for (int s = 0; s < num_pairs(); ++s)
        for (int e = 0; e < h_.d; ++e) {
          const int k = (kLanes * slot + lane) * h_.d + e;
          const double* T_ij =
              T + (pairs_[s].i + components * d * (pairs_[s].j + h_.components * e)) * kLanes + lane;
          Pack t[d];
#pragma GCC unroll 9
          for (int f = 0; f < d; ++f) t[f] = broadcast(T_ij[components * f * kLanes]);
          for (int a = 0; a < packs; ++a) {
            Pack out = t[0] * load(rows + a * kLanes);
#pragma GCC unroll 8
            for (int f = 1; f < d; ++f) out += t[f] * load(rows + (f * packs + a) * kLanes);
            store(product.row(s * packs + a, k), out);
          }
        }
    }
  }

  const PackedBlock& block_;
  const Group &g_, &h_;
  bool same_;
  int packs_;  // of the functions of g
  std::vector<Pair> pairs_;
};

using PointForces = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// The force of S on each unknown of a group, a row, at each point; d numbers a function of `rows`.
template <int components, int d>
void point_forces(const Group& g, int packs, const Mat3Pack* S, Eigen::Ref<PointForces> out) {
  const double* rows = g.rows(0);
  for (int p = 0; p < packs; ++p) {
    Pack Y[kMostCoordinates];
    pull_back(g, p, S[p], Y);
    for (int a = 0; a < g.num_functions; ++a, rows += d * kLanes)
      for (int i = 0; i < components; ++i) {
        Pack sum = load(rows) * Y[i];
#pragma GCC unroll 8
        for (int e = 1; e < d; ++e) sum += load(rows + e * kLanes) * Y[i + components * e];
        store(&out(components * a + i, kLanes * p), sum);
      }
  }
}

}  // namespace

void block_stiffness(const PackedBlock& block, const PackResponse* responses, Matrix& K) {
  const auto n = static_cast<Eigen::Index>(3 * block.functions().size());
  K.resize(n, n);
  TileProduct& product = workspace();
  const auto& groups = block.groups();
  int row0 = 0;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    int col0 = row0;
    for (std::size_t h = g; h < groups.size(); ++h) {
      const GroupStiffness stiffness(block, groups[g], groups[h]);
      stiffness.multiply(responses, product);
      stiffness.write(product, row0, col0, K);
      col0 += groups[h].num_unknowns();
    }
    row0 += groups[g].num_unknowns();
  }
}

void block_force_rows(const PackedBlock& block, const Mat3Pack* S, const Matrix& values, Matrix& rows) {
  const auto n = static_cast<Eigen::Index>(3 * block.functions().size());
  const int packs = block.num_packs();
  thread_local PointForces forces;
  if (forces.rows() < n || forces.cols() < kLanes * packs) forces.resize(n, kLanes * packs);
  int first = 0;
  for (const auto& g : block.groups()) {
    const auto own = forces.block(first, 0, g.num_unknowns(), kLanes * packs);
    (g.components == 1 ? point_forces<1, 9>
     : g.d == 4        ? point_forces<3, 4>
                       : point_forces<3, 3>)(g, packs, S, own);
    first += g.num_unknowns();
  }
  rows.noalias() = values * forces.topLeftCorner(n, values.cols()).transpose();
}

}  // namespace polyaffine
