#include "polyaffine/kinematics/packed_block.hpp"

#include <algorithm>

namespace polyaffine {
namespace {

using Group = PackedBlock::Group;

// Column of the point in lane `lane` of pack `pack`; the last point stands for missing ones.
int point_of(const PointBlock& block, int pack, int lane) {
  return std::min(kLanes * pack + lane, block.count - 1);
}

Group pack_group(const FunctionGroup& g, const PointBlock& block, int packs) {
  Group out;
  out.d = g.d;
  out.num_functions = static_cast<int>(g.functions.size());
  out.padded = (out.num_functions + 3) / 4 * 4;
  out.lifted = !g.lift.empty();
  out.by_point = Matrix::Zero(out.padded, g.d * kLanes * packs);
  for (int p = 0; p < packs; ++p)
    for (int lane = 0; lane < kLanes; ++lane)
      out.by_point.block(0, g.d * (kLanes * p + lane), out.num_functions, g.d) =
          g.rows.middleCols(g.d * point_of(block, p, lane), g.d);
  for (int p = 0; p < packs; ++p)
    for (int a = 0; a < out.num_functions; ++a)
      for (int e = 0; e < g.d; ++e)
        for (int lane = 0; lane < kLanes; ++lane)
          out.by_pack.push_back(out.by_point(a, g.d * (kLanes * p + lane) + e));
  for (auto& row : out.present) std::fill(std::begin(row), std::end(row), false);
  if (!out.lifted) {
    for (int J = 0; J < 3; ++J) out.present[J][J] = true;
    return out;
  }
  for (const auto& L : g.lift)
    for (int J = 0; J < 3; ++J)
      for (int e = 0; e < g.d; ++e) out.present[J][e] |= !L.block<3, 3>(3 * J, 3 * e).isZero(0);
  for (int p = 0; p < packs; ++p)
    for (int j = 0; j < 3 * g.d; ++j)
      for (int i = 0; i < 9; ++i)
        for (int lane = 0; lane < kLanes; ++lane) out.lift.push_back(g.lift[point_of(block, p, lane)](i, j));
  return out;
}

const double* lift_column(const Group& g, int pack, int column) {
  return g.lift.data() + (static_cast<std::ptrdiff_t>(pack) * 3 * g.d + column) * 9 * kLanes;
}

template <int d>
void add_group(const Group& g, int packs, const double* c, Mat3Pack* M) {
  const double* rows = g.by_pack.data();
  for (int p = 0; p < packs; ++p) {
    Pack Y[3 * d] = {};
    for (int a = 0; a < g.num_functions; ++a, rows += d * kLanes) {
      const double* ca = c + 3 * static_cast<std::ptrdiff_t>(a);
#pragma GCC unroll 4
      for (int e = 0; e < d; ++e) {
        const Pack row = load(rows + e * kLanes);
#pragma GCC unroll 3
        for (int k = 0; k < 3; ++k) Y[k + 3 * e] += ca[k] * row;
      }
    }
    if (!g.lifted) {
      for (int i = 0; i < 9; ++i) M[p].m[i] += Y[i];
      continue;
    }
    for (int e = 0; e < d; ++e)
      for (int J = 0; J < 3; ++J)
        if (g.present[J][e])
#pragma GCC unroll 3
          for (int k = 0; k < 3; ++k) {
            const double* L = lift_column(g, p, k + 3 * e) + 3 * kLanes * static_cast<std::ptrdiff_t>(J);
#pragma GCC unroll 3
            for (int m = 0; m < 3; ++m) M[p](m, J) += load(L + m * kLanes) * Y[k + 3 * e];
          }
  }
}

template <int d>
void force_of_group(const Group& g, int packs, const Mat3Pack* S, double* force) {
  std::vector<double> total(static_cast<std::size_t>(3 * g.num_functions * kLanes), 0.0);
  const double* rows = g.by_pack.data();
  for (int p = 0; p < packs; ++p) {
    Pack Y[3 * d];
    pull_back(g, p, S[p], Y);
    double* sums = total.data();
    for (int a = 0; a < g.num_functions; ++a, rows += d * kLanes)
#pragma GCC unroll 3
      for (int k = 0; k < 3; ++k, sums += kLanes) {
        Pack s = load(sums);
#pragma GCC unroll 4
        for (int e = 0; e < d; ++e) s += load(rows + e * kLanes) * Y[k + 3 * e];
        store(sums, s);
      }
  }
  for (int i = 0; i < 3 * g.num_functions; ++i) force[i] = sum(load(total.data() + i * kLanes));
}

}  // namespace

PackedBlock::PackedBlock(const PointBlock& block, const FieldTable& table) : functions_(block.functions()) {
  const int packs = (block.count + kLanes - 1) / kLanes;
  for (int p = 0; p < packs; ++p) {
    points_.push_back({block.first + kLanes * p, std::min(kLanes, block.count - kLanes * p)});
    for (int lane = 0; lane < kLanes; ++lane)
      weights_.push_back(lane < points_[p].lanes ? table.weights[points_[p].point + lane] : 0);
  }
  if (table.base.size() > 0)
    for (int p = 0; p < packs; ++p)
      for (int i = 0; i < 9; ++i)
        for (int lane = 0; lane < kLanes; ++lane)
          base_.push_back(table.base(i, block.first + point_of(block, p, lane)));
  for (const auto& group : block.groups) groups_.push_back(pack_group(group, block, packs));
}

void PackedBlock::field(const Vector& c, bool with_base, Mat3Pack* M) const {
  for (int p = 0; p < num_packs(); ++p)
    for (int i = 0; i < 9; ++i) {
      M[p].m[i] = broadcast(with_base && i % 4 == 0 ? 1 : 0);
      if (with_base && !base_.empty())
        M[p].m[i] = load(base_.data() + (9 * static_cast<std::ptrdiff_t>(p) + i) * kLanes);
    }
  std::vector<double> own;
  for (const int f : functions_) own.insert(own.end(), {c[3 * f], c[3 * f + 1], c[3 * f + 2]});
  const double* at = own.data();
  for (const auto& g : groups_) {
    (g.d == 4 ? add_group<4> : add_group<3>)(g, num_packs(), at, M);
    at += 3 * static_cast<std::ptrdiff_t>(g.num_functions);
  }
}

void PackedBlock::force(const Mat3Pack* S, Matrix& out) const {
  out.resize(3, static_cast<Eigen::Index>(functions_.size()));
  double* at = out.data();
  for (const auto& g : groups_) {
    (g.d == 4 ? force_of_group<4> : force_of_group<3>)(g, num_packs(), S, at);
    at += 3 * static_cast<std::ptrdiff_t>(g.num_functions);
  }
}

void pull_back(const PackedBlock::Group& g, int pack, const Mat3Pack& S, Pack* Y) {
  if (!g.lifted) {
    for (int i = 0; i < 9; ++i) Y[i] = S.m[i];
    return;
  }
  for (int e = 0; e < g.d; ++e) {
    Pack y[3] = {};
    for (int J = 0; J < 3; ++J) {
      if (!g.present[J][e]) continue;
#pragma GCC unroll 3
      for (int k = 0; k < 3; ++k) {
        const double* L = lift_column(g, pack, k + 3 * e) + 3 * kLanes * static_cast<std::ptrdiff_t>(J);
#pragma GCC unroll 3
        for (int m = 0; m < 3; ++m) y[k] += load(L + m * kLanes) * S.m[m + 3 * J];
      }
    }
#pragma GCC unroll 3
    for (int k = 0; k < 3; ++k) Y[k + 3 * e] = y[k];
  }
}

}  // namespace polyaffine
