#pragma once

#include <vector>

#include <polyaffine/kinematics/field_table.hpp>
#include <polyaffine/material/batch.hpp>

namespace polyaffine {

/// Packs [begin, end) of a block.
struct PackRange {
  int begin = 0, end = 0;
  int size() const { return end - begin; }
};

/// A block of a field table laid out for the inner loops: kLanes points side by side, so that the field, its
/// transpose and the stiffness are sums of SIMD products. The last pack repeats the last point of the block
/// where points are missing; those lanes have weight zero.
class PackedBlock {
 public:
  /// Scalar functions with three components each, or modes with one (then num_functions counts modes, and
  /// d = 9 numbers of a mode are its part of the field).
  struct Group {
    int d = 3;
    int components = 3;
    int num_functions = 0;
    int padded = 0;       ///< functions, rounded up to a multiple of four
    bool lifted = false;  ///< the lift is not the identity
    int place[3][4];      ///< of the 3×3 blocks of the lift among the stored ones; −1: zero
    int stored = 0;       ///< 3×3 blocks that differ
    /// Row e of function a at the points of pack p: kLanes numbers from ((p · num_functions + a) d + e)
    /// kLanes.
    std::vector<double> by_pack;
    /// The same rows, function a fastest: padded × (d · kLanes · packs), point after point.
    Matrix by_point;
    /// Entry (i, j) of stored block b of pack p: kLanes numbers from ((p · stored + b) 9 + i + 3j) kLanes.
    std::vector<double> lift;
    int num_unknowns() const { return components * num_functions; }
    /// The rows at a pack and behind it.
    const double* rows(int pack) const {
      return by_pack.data() + static_cast<std::ptrdiff_t>(pack) * num_functions * d * kLanes;
    }
    const double* lift_block(int pack, int J, int e) const {
      return lift.data() + (static_cast<std::ptrdiff_t>(pack) * stored + place[J][e]) * 9 * kLanes;
    }
  };

  PackedBlock(const PointBlock& block, const FieldTable& table);

  int num_packs() const { return static_cast<int>(points_.size()); }
  PackRange all() const { return {0, num_packs()}; }
  PackPoints points(int pack) const { return points_[pack]; }
  [[gnu::always_inline]] Pack weight(int pack) const {
    return load(weights_.data() + kLanes * static_cast<std::ptrdiff_t>(pack));
  }
  /// Function indices of all groups, in order; the local numbering.
  const std::vector<int>& functions() const { return functions_; }
  const std::vector<Group>& groups() const { return groups_; }

  /// M of some packs for the unknowns c; the constant M⁰ only if `with_base`.
  void field(const Vector& c, bool with_base, PackRange packs, Mat3Pack* M) const;
  /// M with M⁰ and its change by the rate of c, in one pass over the rows.
  void field_and_rate(const Vector& c, const Vector& rate, PackRange packs, Mat3Pack* M,
                      Mat3Pack* M_rate) const;
  /// The transpose: the 3 × functions force Σ_q S_q : ∂M_q/∂c of values S at some packs.
  void force(const Mat3Pack* S, PackRange packs, Matrix& out) const;

 private:
  void gather(const Vector& c, std::vector<double>& own) const;
  Mat3Pack base(int pack) const;

  std::vector<PackPoints> points_;
  std::vector<double> weights_;
  std::vector<double> base_;  // 9 numbers a pack; empty: the identity
  std::vector<int> functions_;
  std::vector<Group> groups_;
};

/// S pulled back to the coordinates vec(3×d) of a group at one pack, Y = LᵀS: entry k of column e has index
/// k + 3e. Of modes Y is S.
void pull_back(const PackedBlock::Group& group, int pack, const Mat3Pack& S, Pack* Y);

}  // namespace polyaffine
