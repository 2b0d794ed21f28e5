#include "polyaffine/kinematics/field_table.hpp"

namespace polyaffine {

int PointBlock::num_functions() const {
  std::size_t n = 0;
  for (const auto& g : groups) n += g.functions.size();
  return static_cast<int>(n);
}

std::vector<int> PointBlock::functions() const {
  std::vector<int> all;
  for (const auto& g : groups) all.insert(all.end(), g.functions.begin(), g.functions.end());
  return all;
}

namespace {

// Blocks of so few points, those of elements, are summed as they are: products of matrices would spend their
// time on copies.
constexpr int kFewPoints = 4;

bool is_small(const PointBlock& block) {
  return block.count <= kFewPoints && block.groups.size() == 1 && block.groups[0].lift.empty() &&
         !block.groups[0].is_modes();
}

void add_small(const PointBlock& block, const Vector& c, double* field) {
  const FunctionGroup& g = block.groups[0];
  for (int q = 0; q < block.count; ++q) {
    Eigen::Map<Mat3> at(field + 9 * q);
    for (std::size_t a = 0; a < g.functions.size(); ++a)
      at.noalias() +=
          c.segment<3>(3 * g.functions[a]) * g.rows.block<1, 3>(static_cast<Eigen::Index>(a), 3 * q);
  }
}

}  // namespace

Matrix gather(const PointBlock& block, const Vector& c) {
  Matrix out(3, block.num_functions());
  int a = 0;
  for (const auto& g : block.groups)
    for (const int f : g.functions) out.col(a++) = c.segment<3>(3 * f);
  return out;
}

void add_field(const PointBlock& block, const Matrix& coefficients, double* field) {
  int a0 = 0;
  for (const auto& g : block.groups) {
    const int n = static_cast<int>(g.functions.size());
    if (g.is_modes()) {
      Eigen::Map<Vector>(field, 9 * block.count).noalias() +=
          g.modes.transpose() * coefficients.middleCols(a0, n).reshaped();
    } else if (g.lift.empty()) {
      Eigen::Map<Matrix>(field, 3, 3 * block.count).noalias() += coefficients.middleCols(a0, n) * g.rows;
    } else {
      const Matrix Y = coefficients.middleCols(a0, n) * g.rows;
      for (int q = 0; q < block.count; ++q)
        Eigen::Map<Eigen::Matrix<double, 9, 1>>(field + 9 * q).noalias() +=
            g.lift[q] * Eigen::Map<const Vector>(Y.data() + 3 * g.d * q, 3 * g.d);
    }
    a0 += n;
  }
}

void add_field_transpose(const PointBlock& block, const double* S, Matrix& force) {
  int a0 = 0;
  for (const auto& g : block.groups) {
    const int n = static_cast<int>(g.functions.size());
    if (g.is_modes()) {
      force.middleCols(a0, n).reshaped() += g.modes * Eigen::Map<const Vector>(S, 9 * block.count);
    } else if (g.lift.empty()) {
      force.middleCols(a0, n).noalias() +=
          Eigen::Map<const Matrix>(S, 3, 3 * block.count) * g.rows.transpose();
    } else {
      Matrix Y(3, g.d * block.count);
      for (int q = 0; q < block.count; ++q)
        Eigen::Map<Vector>(Y.data() + 3 * g.d * q, 3 * g.d).noalias() =
            g.lift[q].transpose() * Eigen::Map<const Eigen::Matrix<double, 9, 1>>(S + 9 * q);
      force.middleCols(a0, n).noalias() += Y * g.rows.transpose();
    }
    a0 += n;
  }
}

Matrix evaluate_field(const FieldTable& table, const Vector& c) {
  Matrix field(9, table.num_points());
  if (table.base.size() > 0)
    field = table.base;
  else
    field.colwise() = Mat3::Identity().reshaped();
  for (const auto& block : table.blocks) {
    double* at = field.col(block.first).data();
    if (is_small(block))
      add_small(block, c, at);
    else
      add_field(block, gather(block, c), at);
  }
  return field;
}

}  // namespace polyaffine
