#include "polyaffine/system/state.hpp"

#include <stdexcept>

namespace polyaffine {

Unknowns StateLayout::add(Block block, int size) {
  for (const Block& other : blocks_)
    if (other.name == block.name) throw std::invalid_argument("state: two blocks " + block.name);
  if (block.solved == Solved::field && !blocks_.empty())
    throw std::invalid_argument("state: the field " + block.name + " must be the first block");
  block.at = {this->size(), size};
  for (int i = block.at.first; i < block.at.end(); ++i) {
    const bool is_few = block.solved == Solved::few;
    few_index_.push_back(is_few ? static_cast<int>(few_.size()) : -1);
    if (is_few) few_.push_back(i);
  }
  blocks_.push_back(std::move(block));
  return blocks_.back().at;
}

Unknowns StateLayout::field() const {
  return blocks_.empty() || blocks_.front().solved != Solved::field ? Unknowns{} : blocks_.front().at;
}

Unknowns StateLayout::find(const std::string& name) const {
  for (const Block& block : blocks_)
    if (block.name == name) return block.at;
  throw std::invalid_argument("state: no block " + name);
}

}  // namespace polyaffine
