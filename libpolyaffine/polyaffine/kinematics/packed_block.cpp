#include "polyaffine/kinematics/packed_block.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace polyaffine {
namespace {

using Group = PackedBlock::Group;

// Column of the point in lane `lane` of pack `pack`; the last point stands for missing ones.
int point_of(const PointBlock& block, int pack, int lane) {
  return std::min(kLanes * pack + lane, block.count - 1);
}

// Block (J, e) of a lift.
auto part(const FunctionGroup::Lift& L, int J, int e) {
  return L.block<3, 3>(3 * static_cast<Eigen::Index>(J), 3 * static_cast<Eigen::Index>(e));
}

// Lays out the 3×3 blocks (J, e) of a group's lifts. Many of them are zero or the same at all points (Q
// stands three times in the lift of a gradient), so each is stored once and `place` tells where.
void pack_lifts(const FunctionGroup& g, const PointBlock& block, int packs, Group& out) {
  const auto is_zero = [&](int J, int e) {
    return std::ranges::all_of(g.lift, [&](const auto& L) { return part(L, J, e).isZero(0); });
  };
  const auto are_equal = [&](int J, int e, int K, int f) {
    return std::ranges::all_of(g.lift, [&](const auto& L) { return part(L, J, e) == part(L, K, f); });
  };
  std::vector<std::pair<int, int>> stored;  // (J, e) of the first of equal blocks
  for (int J = 0; J < 3; ++J)
    for (int e = 0; e < g.d; ++e) {
      if (is_zero(J, e)) continue;
      const auto equal = std::ranges::find_if(
          stored, [&](const auto& other) { return are_equal(J, e, other.first, other.second); });
      out.place[J][e] = static_cast<int>(equal - stored.begin());
      if (equal == stored.end()) stored.emplace_back(J, e);
    }
  out.stored = static_cast<int>(stored.size());
  for (int p = 0; p < packs; ++p)
    for (const auto& [J, e] : stored)
      for (int k = 0; k < 3; ++k)
        for (int m = 0; m < 3; ++m)
          for (int lane = 0; lane < kLanes; ++lane)
            out.lift.push_back(part(g.lift[point_of(block, p, lane)], J, e)(m, k));
}

Group pack_group(const FunctionGroup& g, const PointBlock& block, int packs) {
  Group out;
  out.d = g.d;
  const Matrix& rows = g.is_modes() ? g.modes : g.rows;
  out.components = g.is_modes() ? 1 : 3;
  out.num_functions = static_cast<int>(rows.rows());
  out.padded = (out.num_functions + 3) / 4 * 4;
  out.lifted = !g.lift.empty();
  out.by_point = Matrix::Zero(out.padded, g.d * kLanes * packs);
  for (int p = 0; p < packs; ++p)
    for (int lane = 0; lane < kLanes; ++lane)
      out.by_point.block(0, g.d * (kLanes * p + lane), out.num_functions, g.d) =
          rows.middleCols(g.d * point_of(block, p, lane), g.d);
  for (int p = 0; p < packs; ++p)
    for (int a = 0; a < out.num_functions; ++a)
      for (int e = 0; e < g.d; ++e)
        for (int lane = 0; lane < kLanes; ++lane)
          out.by_pack.push_back(out.by_point(a, g.d * (kLanes * p + lane) + e));
  for (auto& row : out.place) std::fill(std::begin(row), std::end(row), -1);
  if (out.lifted) pack_lifts(g, block, packs, out);
  return out;
}

// The field of a group at one pack: adds to M.
template <int d>
void add_pack(const Group& g, int p, const double* c, Mat3Pack& M) {
  const double* rows = g.rows(p);
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
    for (int i = 0; i < 9; ++i) M.m[i] += Y[i];
    return;
  }
  for (int e = 0; e < d; ++e)
    for (int J = 0; J < 3; ++J) {
      if (g.place[J][e] < 0) continue;
      const double* L = g.lift_block(p, J, e);
#pragma GCC unroll 3
      for (int k = 0; k < 3; ++k)
#pragma GCC unroll 3
        for (int m = 0; m < 3; ++m) M(m, J) += load(L + (m + 3 * k) * kLanes) * Y[k + 3 * e];
    }
}

void add_modes(const Group& g, int p, const double* c, Mat3Pack& M) {
  const double* rows = g.rows(p);
  for (int m = 0; m < g.num_functions; ++m, rows += 9 * kLanes)
#pragma GCC unroll 9
    for (int e = 0; e < 9; ++e) M.m[e] += c[m] * load(rows + e * kLanes);
}

void add_pack(const Group& g, int p, const double* c, Mat3Pack& M) {
  if (g.components == 1) return add_modes(g, p, c, M);
  (g.d == 4 ? add_pack<4> : add_pack<3>)(g, p, c, M);
}

template <int d>
void force_of_group(const Group& g, PackRange packs, const Mat3Pack* S, double* force) {
  thread_local std::vector<double> total;
  total.assign(static_cast<std::size_t>(3 * g.num_functions * kLanes), 0.0);
  const double* rows = g.rows(packs.begin);
  for (int p = packs.begin; p < packs.end; ++p, ++S) {
    Pack Y[3 * d];
    pull_back(g, p, *S, Y);
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

void force_of_modes(const Group& g, PackRange packs, const Mat3Pack* S, double* force) {
  thread_local std::vector<double> total;
  total.assign(static_cast<std::size_t>(g.num_functions * kLanes), 0.0);
  const double* rows = g.rows(packs.begin);
  for (int p = packs.begin; p < packs.end; ++p, ++S)
    for (int m = 0; m < g.num_functions; ++m, rows += 9 * kLanes) {
      Pack s = load(total.data() + m * kLanes);
#pragma GCC unroll 9
      for (int e = 0; e < 9; ++e) s += load(rows + e * kLanes) * S->m[e];
      store(total.data() + m * kLanes, s);
    }
  for (int m = 0; m < g.num_functions; ++m) force[m] = sum(load(total.data() + m * kLanes));
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

void PackedBlock::gather(const Vector& c, std::vector<double>& own) const {
  own.resize(3 * functions_.size());
  double* at = own.data();
  for (const int f : functions_) at = std::copy_n(c.data() + 3 * static_cast<std::ptrdiff_t>(f), 3, at);
}

Mat3Pack PackedBlock::base(int pack) const {
  Mat3Pack M;
  for (int i = 0; i < 9; ++i)
    M.m[i] = base_.empty() ? broadcast(i % 4 == 0 ? 1 : 0)
                           : load(base_.data() + (9 * static_cast<std::ptrdiff_t>(pack) + i) * kLanes);
  return M;
}

void PackedBlock::field(const Vector& c, bool with_base, PackRange packs, Mat3Pack* M) const {
  thread_local std::vector<double> own;
  gather(c, own);
  for (int p = packs.begin; p < packs.end; ++p, ++M) {
    *M = with_base ? base(p) : Mat3Pack{};
    const double* at = own.data();
    for (const auto& g : groups_) {
      add_pack(g, p, at, *M);
      at += g.num_unknowns();
    }
  }
}

void PackedBlock::field_and_rate(const Vector& c, const Vector& rate, PackRange packs, Mat3Pack* M,
                                 Mat3Pack* M_rate) const {
  thread_local std::vector<double> own, own_rate;
  gather(c, own);
  gather(rate, own_rate);
  for (int p = packs.begin; p < packs.end; ++p, ++M, ++M_rate) {
    *M = base(p);
    *M_rate = Mat3Pack{};
    std::ptrdiff_t at = 0;
    for (const auto& g : groups_) {
      add_pack(g, p, own.data() + at, *M);
      add_pack(g, p, own_rate.data() + at, *M_rate);
      at += g.num_unknowns();
    }
  }
}

void PackedBlock::force(const Mat3Pack* S, PackRange packs, Matrix& out) const {
  out.resize(3, static_cast<Eigen::Index>(functions_.size()));
  double* at = out.data();
  for (const auto& g : groups_) {
    (g.components == 1 ? force_of_modes : g.d == 4 ? force_of_group<4> : force_of_group<3>)(g, packs, S, at);
    at += g.num_unknowns();
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
      if (g.place[J][e] < 0) continue;
      const double* L = g.lift_block(pack, J, e);
#pragma GCC unroll 3
      for (int k = 0; k < 3; ++k)
#pragma GCC unroll 3
        for (int m = 0; m < 3; ++m) y[k] += load(L + (m + 3 * k) * kLanes) * S.m[m + 3 * J];
    }
#pragma GCC unroll 3
    for (int k = 0; k < 3; ++k) Y[k + 3 * e] = y[k];
  }
}

}  // namespace polyaffine
