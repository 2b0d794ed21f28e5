#include "polyaffine/system/volume_gradient.hpp"

#include <utility>

namespace polyaffine {
namespace {

std::vector<int> unknowns_of(const std::vector<int>& functions) {
  std::vector<int> out;
  out.reserve(3 * functions.size());
  for (const int f : functions)
    for (int k = 0; k < 3; ++k) out.push_back(3 * f + k);
  return out;
}

}  // namespace

VolumeGradient::VolumeGradient(const PressureSpace& space, const FieldTable& table, bool by_block)
    : table_(&table), by_block_(by_block), pressures_(space.num_functions), unknowns_(table.num_unknowns()) {
  if (!by_block_) whole_ = Matrix::Zero(pressures_, unknowns_);
}

void VolumeGradient::add(std::size_t block, const PressureSpace& space, Matrix rows) {
  const std::vector<int>& pressures = space.blocks[block].functions;
  std::vector<int> unknowns = unknowns_of(table_->blocks[block].functions());
  if (by_block_)
    parts_.push_back({pressures, std::move(unknowns), std::move(rows)});
  else
    whole_(pressures, unknowns) += rows;
}

// Blocks are many and small: products of Eigen would take most of their time for memory.
template <class Work>
void VolumeGradient::for_each(const Work& work, Eigen::Index columns) const {
  for (Eigen::Index k = 0; k < columns; ++k)
    for (const Part& part : parts_)
      for (std::size_t j = 0; j < part.unknowns.size(); ++j)
        for (std::size_t i = 0; i < part.pressures.size(); ++i)
          work(part.pressures[i], part.unknowns[j],
               part.rows(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)), k);
}

Matrix VolumeGradient::times(const Matrix& u) const {
  if (!by_block_) return whole_ * u;
  Matrix out = Matrix::Zero(pressures_, u.cols());
  for_each([&](int pressure, int unknown, double entry,
               Eigen::Index k) { out(pressure, k) += entry * u(unknown, k); },
           u.cols());
  return out;
}

Matrix VolumeGradient::transpose_times(const Matrix& p) const {
  if (!by_block_) return whole_.transpose() * p;
  Matrix out = Matrix::Zero(unknowns_, p.cols());
  for_each([&](int pressure, int unknown, double entry,
               Eigen::Index k) { out(unknown, k) += entry * p(pressure, k); },
           p.cols());
  return out;
}

}  // namespace polyaffine
