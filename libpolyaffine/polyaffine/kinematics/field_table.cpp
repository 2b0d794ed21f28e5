#include "polyaffine/kinematics/field_table.hpp"

namespace polyaffine {
namespace {

using Mat9 = Eigen::Matrix<double, 9, 9>;
using SmallMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 12, 12>;

// Ã = L_gᵀ A L_h, in the coordinates vec(3×d) of each group.
SmallMatrix pull_back(const FunctionGroup& g, const FunctionGroup& h, int q, const Mat9& A) {
  if (g.lift.empty() && h.lift.empty()) return A;
  if (g.lift.empty()) return A * h.lift[q];
  if (h.lift.empty()) return g.lift[q].transpose() * A;
  return g.lift[q].transpose() * (A * h.lift[q]);
}

// Adds the blocks of functions of g (rows) against functions of h (columns).
void group_stiffness(const PointBlock& block, const FunctionGroup& g, const FunctionGroup& h, int row0,
                     int col0, bool same, const double* A, Matrix& K) {
  const int ng = static_cast<int>(g.functions.size());
  const int nh = static_cast<int>(h.functions.size());
  // weighted[i][j] is rows(g)·Ã_ij: functions × (d_h · points)
  Matrix weighted[3][3];
  for (int i = 0; i < 3; ++i)
    for (int j = same ? i : 0; j < 3; ++j) weighted[i][j].resize(ng, h.d * block.count);
  for (int q = 0; q < block.count; ++q) {
    const SmallMatrix T = pull_back(g, h, q, Eigen::Map<const Mat9>(A + 81 * q));
    const auto rows = g.rows.middleCols(g.d * q, g.d);
    for (int i = 0; i < 3; ++i)
      for (int j = same ? i : 0; j < 3; ++j)
        for (int e = 0; e < h.d; ++e) {
          auto out = weighted[i][j].col(h.d * q + e);
          out.noalias() = T(i, j + 3 * e) * rows.col(0);
          for (int d = 1; d < g.d; ++d) out.noalias() += T(i + 3 * d, j + 3 * e) * rows.col(d);
        }
  }
  Matrix part(ng, nh);
  for (int i = 0; i < 3; ++i)
    for (int j = same ? i : 0; j < 3; ++j) {
      part.noalias() = weighted[i][j] * h.rows.transpose();
      for (int b = 0; b < nh; ++b)
        for (int a = 0; a < ng; ++a) {
          K(row0 + 3 * a + i, col0 + 3 * b + j) += part(a, b);
          if (!same || i != j) K(col0 + 3 * b + j, row0 + 3 * a + i) += part(a, b);
        }
    }
}

}  // namespace

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
    if (g.lift.empty()) {
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
    if (g.lift.empty()) {
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
  for (const auto& block : table.blocks) add_field(block, gather(block, c), field.col(block.first).data());
  return field;
}

void block_stiffness(const PointBlock& block, const double* A, Matrix& K) {
  const int n = 3 * block.num_functions();
  K.setZero(n, n);
  int row0 = 0;
  for (std::size_t g = 0; g < block.groups.size(); ++g) {
    int col0 = row0;
    for (std::size_t h = g; h < block.groups.size(); ++h) {
      group_stiffness(block, block.groups[g], block.groups[h], row0, col0, g == h, A, K);
      col0 += 3 * static_cast<int>(block.groups[h].functions.size());
    }
    row0 += 3 * static_cast<int>(block.groups[g].functions.size());
  }
}

}  // namespace polyaffine
