#include "polyaffine/system/sparse_field.hpp"

#include <polyaffine/linear/sparse_system.hpp>

namespace polyaffine {

std::unique_ptr<LinearSystem> sparse_field(const System& system) {
  std::vector<const FieldTable*> tables;
  for (const auto& term : system.terms) term->add_tables(tables);
  return sparse_system(tables, system.fixed, false, system.held);
}

}  // namespace polyaffine
