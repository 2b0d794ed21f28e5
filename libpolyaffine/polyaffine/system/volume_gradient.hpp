#pragma once

#include <vector>

#include <polyaffine/system/pressure_space.hpp>

namespace polyaffine {

/// D = ∂g/∂c of a pressure space (see PressureSpace) at a state, pressures × unknowns, mm². Where every
/// pressure lives in one block only it is kept block by block, otherwise as one dense matrix.
class VolumeGradient {
 public:
  VolumeGradient() = default;
  /// Zeros. `by_block`: keep the blocks apart. The table must outlive it.
  VolumeGradient(const PressureSpace& space, const FieldTable& table, bool by_block);

  /// Adds the part of a block: its pressures × the three unknowns of each of its functions.
  void add(std::size_t block, const PressureSpace& space, Matrix rows);
  /// D u: how the volumes g change along a step u; one a column.
  Matrix times(const Matrix& u) const;
  /// Dᵀ p: the forces of pressures; those of one field of pressures a column.
  Matrix transpose_times(const Matrix& p) const;
  /// D as one matrix, of a gradient that is not kept by block.
  const Matrix& whole() const { return whole_; }

 private:
  struct Part {
    std::vector<int> pressures, unknowns;
    Matrix rows;
  };
  // work(pressure, unknown, entry, column) for every entry of every block.
  template <class Work>
  void for_each(const Work& work, Eigen::Index columns) const;

  const FieldTable* table_ = nullptr;
  bool by_block_ = false;
  Eigen::Index pressures_ = 0, unknowns_ = 0;
  Matrix whole_;             // unless by_block
  std::vector<Part> parts_;  // if by_block
};

}  // namespace polyaffine
