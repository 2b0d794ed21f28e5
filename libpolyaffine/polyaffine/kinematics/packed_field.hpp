#pragma once

#include <vector>

#include <polyaffine/kinematics/packed_block.hpp>

namespace polyaffine {

/// The field of a table for many coefficients: evaluate_field with rows that are laid out once, for a third
/// of its work where a block sees many functions.
class PackedField {
 public:
  explicit PackedField(const FieldTable& table);
  /// M_q at all points, 9 × points.
  Matrix at(const Vector& c) const;

 private:
  int points_;
  std::vector<PackedBlock> blocks_;
};

}  // namespace polyaffine
