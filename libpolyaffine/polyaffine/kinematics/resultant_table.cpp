#include "polyaffine/kinematics/resultant_table.hpp"

#include <stdexcept>

namespace polyaffine {

FieldTable resultant_table(const FieldTable& table) {
  Eigen::Matrix<double, Eigen::Dynamic, 3> rows = Matrix::Zero(table.num_functions, 3);
  std::vector<char> seen(table.num_functions, 0);
  for (const PointBlock& block : table.blocks)
    for (const FunctionGroup& group : block.groups) {
      if (!group.lift.empty() || group.is_modes())
        throw std::invalid_argument("resultant table: expected functions without local axes and no modes");
      for (std::size_t a = 0; a < group.functions.size(); ++a) {
        seen[group.functions[a]] = 1;
        for (int q = 0; q < block.count; ++q)
          rows.row(group.functions[a]) +=
              table.weights[block.first + q] * group.rows.block<1, 3>(static_cast<Eigen::Index>(a), 3 * q);
      }
    }
  FunctionGroup all;
  for (int a = 0; a < table.num_functions; ++a)
    if (seen[a]) all.functions.push_back(a);
  all.rows = rows(all.functions, Eigen::all);

  FieldTable out;
  out.num_functions = table.num_functions;
  out.weights = Vector::Ones(1);
  if (table.base.size() > 0)
    out.base = table.base * table.weights;
  else
    out.base = table.weights.sum() * Mat3::Identity().reshaped();
  out.blocks.push_back({0, 1, {std::move(all)}});
  return out;
}

}  // namespace polyaffine
