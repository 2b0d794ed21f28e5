#pragma once

#include <string>
#include <vector>

#include <polyaffine/core/types.hpp>

namespace polyaffine {

/// Places of some unknowns in the vector y of all unknowns of a system: they look at it by themselves.
struct Unknowns {
  int first = 0, size = 0;

  auto of(const Vector& y) const { return y.segment(first, size); }
  auto of(Vector& y) const { return y.segment(first, size); }
  int end() const { return first + size; }
};

/// How Newton's method finds the unknowns of a block.
enum class Solved {
  field,  ///< the coefficients of functions: by a LinearSystem, the first block
  apart,  ///< by the one term that owns them and can eliminate them (pressures, velocities, state of points)
  few     ///< some numbers (volumes, pressures of cavities and vessels): by one small dense system
};

/// A named part of the state of a system.
struct Block {
  std::string name;  ///< "displacement"
  std::string unit;  ///< "mm"
  Solved solved = Solved::few;
  /// Of time integration, in the unit; infinite: no norm sees the unknowns, which follow the others.
  double absolute_tolerance = 0;
  /// False for multipliers of constraints (of index 2): their error is that of the others over the step, so
  /// that smaller steps do not lessen it (Brenan, Campbell and Petzold 1996, §5.2).
  bool error_tested = true;
  Unknowns at = {};  ///< set by StateLayout
};

/// The blocks that the unknowns of a system consist of, in their order. Time integration, checkpoints and
/// messages read names, units and tolerances here; terms are given the Unknowns they speak of.
class StateLayout {
 public:
  /// Adds a block of `size` unknowns behind the others. Throws std::invalid_argument for a name twice, and
  /// for a field that is not the first block.
  Unknowns add(Block block, int size);

  int size() const { return blocks_.empty() ? 0 : blocks_.back().at.end(); }
  /// The first block if it is a field, else none.
  Unknowns field() const;
  const std::vector<Block>& blocks() const { return blocks_; }
  /// The unknowns of a name. Throws std::invalid_argument when there is none.
  Unknowns find(const std::string& name) const;

  /// The places of all unknowns that are solved as `few`, in their order.
  const std::vector<int>& few() const { return few_; }
  /// The number of such an unknown among them.
  int few_index(int unknown) const { return few_index_.at(static_cast<std::size_t>(unknown)); }

 private:
  std::vector<Block> blocks_;
  std::vector<int> few_;
  std::vector<int> few_index_;  // of every unknown; −1 for those solved otherwise
};

}  // namespace polyaffine
