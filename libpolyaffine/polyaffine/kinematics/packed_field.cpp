#include "polyaffine/kinematics/packed_field.hpp"

#include <polyaffine/core/parallel.hpp>

namespace polyaffine {

PackedField::PackedField(const FieldTable& table) : points_(table.num_points()) {
  blocks_.reserve(table.blocks.size());
  for (const PointBlock& block : table.blocks) blocks_.emplace_back(block, table);
}

Matrix PackedField::at(const Vector& c) const {
  Matrix out = Matrix::Zero(9, points_);
  parallel_for(0, static_cast<int>(blocks_.size()), [&](int k) {
    const PackedBlock& block = blocks_[static_cast<std::size_t>(k)];
    thread_local std::vector<Mat3Pack> field;
    field.resize(static_cast<std::size_t>(block.num_packs()));
    block.field(c, true, block.all(), field.data());
    for (int pack = 0; pack < block.num_packs(); ++pack) {
      const auto [point, lanes] = block.points(pack);
      scatter_add_points<9>(out.col(point).data(), lanes, field[static_cast<std::size_t>(pack)].m);
    }
  });
  return out;
}

}  // namespace polyaffine
