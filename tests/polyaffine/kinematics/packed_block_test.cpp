#include <gtest/gtest.h>

#include <polyaffine/kinematics/block_products.hpp>
#include <polyaffine/kinematics/packed_field.hpp>
#include "rotating_basis.hpp"

namespace polyaffine {
namespace {

using testing::random_vector;
using testing::RotatingBasis;

constexpr double kRounding = 1e-13;  // of sums of products of order one

// A block of 13 points (packs of four and a last one of one) that sees 17 plain functions, 6 in local axes
// and a table of its own; all numbers random.
FieldTable random_table(int plain, int local, int count) {
  FieldTable table;
  table.num_functions = plain + local;
  table.weights = random_vector(count, 1, 1);
  table.base = random_vector(9 * count, 1, 2).reshaped(9, count);
  PointBlock block{0, count, {}};
  for (const bool lifted : {false, true}) {
    const int n = lifted ? local : plain, d = lifted ? 4 : 3;
    if (n == 0) continue;
    FunctionGroup group;
    group.d = d;
    for (int a = 0; a < n; ++a) group.functions.push_back(lifted ? a : local + a);
    group.rows = random_vector(n * d * count, 1, 3 + d).reshaped(n, d * count);
    for (int q = 0; lifted && q < count; ++q)
      group.lift.emplace_back(random_vector(9 * 3 * d, 1, 10 + q).reshaped(9, 3 * d));
    block.groups.push_back(group);
  }
  table.blocks.push_back(block);
  return table;
}

// The 9 × unknowns derivative of the field at point q by the block's own coefficients, column by column.
Matrix field_derivative(const PointBlock& block, int q) {
  Matrix B(9, 3 * block.num_functions());
  for (Eigen::Index k = 0; k < B.cols(); ++k) {
    Matrix unit = Matrix::Zero(3, block.num_functions());
    unit.reshaped()[k] = 1;
    Matrix field = Matrix::Zero(9, block.count);
    add_field(block, unit, field.data());
    B.col(k) = field.col(q);
  }
  return B;
}

std::vector<Mat3Pack> packed(const PackedBlock& block, const Matrix& values) {
  std::vector<Mat3Pack> out;
  for (int p = 0; p < block.num_packs(); ++p)
    out.push_back(gather_matrix(values.col(block.points(p).point).data(), block.points(p).lanes));
  return out;
}

// Lanes without a point must not count, as in sums with weight zero.
std::vector<Mat3Pack> weighted(const PackedBlock& block, std::vector<Mat3Pack> values) {
  for (int p = 0; p < block.num_packs(); ++p)
    for (Pack& v : values[p].m) v *= block.weight(p);
  return values;
}

class PackedBlocks : public ::testing::TestWithParam<std::pair<int, int>> {
 protected:
  FieldTable table = random_table(GetParam().first, GetParam().second, 13);
  const PointBlock& block = table.blocks[0];
  PackedBlock fast{block, table};
};

TEST_P(PackedBlocks, FieldIsThatOfTheTable) {
  const Vector c = random_vector(table.num_unknowns(), 1, 6);
  const Matrix field = evaluate_field(table, c);
  std::vector<Mat3Pack> M(fast.num_packs()), rate(fast.num_packs());
  fast.field(c, true, fast.all(), M.data());
  fast.field(c, false, fast.all(), rate.data());
  for (int q = 0; q < block.count; ++q)
    for (int i = 0; i < 9; ++i) {
      EXPECT_NEAR(M[q / kLanes].m[i][q % kLanes], field(i, q), kRounding * 10);
      EXPECT_NEAR(rate[q / kLanes].m[i][q % kLanes], field(i, q) - table.base(i, q), kRounding * 10);
    }
  const int last = block.count - 1;  // repeated in the lanes without a point
  for (int lane = last % kLanes; lane < kLanes; ++lane)
    EXPECT_EQ(M.back().m[0][lane], M.back().m[0][last % kLanes]);
}

TEST_P(PackedBlocks, ForceIsTheTransposeOfTheField) {
  const Matrix S = random_vector(9 * block.count, 1, 7).reshaped(9, block.count);
  Matrix expected = Matrix::Zero(3, block.num_functions()), force;
  const Matrix with_weights = S * table.weights.asDiagonal();
  add_field_transpose(block, with_weights.data(), expected);
  fast.force(weighted(fast, packed(fast, S)).data(), fast.all(), force);
  EXPECT_LT((force - expected).norm(), kRounding * expected.norm());
}

TEST_P(PackedBlocks, StiffnessIsTheSumOverPoints) {
  const auto n = 3 * block.num_functions();
  Matrix expected = Matrix::Zero(n, n), K;
  std::vector<PackResponse> responses(fast.num_packs());
  for (auto& r : responses) clear(r, true);
  for (int q = 0; q < block.count; ++q) {
    const Matrix half = random_vector(81, 1, 100 + q).reshaped(9, 9);
    const Matrix A = half + half.transpose();
    const Matrix B = field_derivative(block, q);
    expected += B.transpose() * A * B;
    for (int i = 0; i < 9; ++i)
      for (int j = 0; j < 9; ++j) responses[q / kLanes].A[i][j][q % kLanes] = A(i, j);
  }
  block_stiffness(fast, responses.data(), K);
  EXPECT_LT((K - expected).norm(), kRounding * expected.norm());
  EXPECT_EQ(K, K.transpose());
}

TEST_P(PackedBlocks, ForceRowsAreForcesOfScaledFields) {
  const Matrix S = random_vector(9 * block.count, 1, 8).reshaped(9, block.count);
  const Matrix values = random_vector(7 * block.count, 1, 9).reshaped(7, block.count);
  Matrix rows;
  block_force_rows(fast, weighted(fast, packed(fast, S)).data(), values, rows);
  ASSERT_EQ(rows.rows(), 7);
  for (int b = 0; b < 7; ++b) {
    Matrix force = Matrix::Zero(3, block.num_functions());
    const Matrix scaled = S * values.row(b).asDiagonal() * table.weights.asDiagonal();
    add_field_transpose(block, scaled.data(), force);
    EXPECT_LT((rows.row(b).transpose() - force.reshaped()).norm(), kRounding * force.norm());
  }
}

INSTANTIATE_TEST_SUITE_P(Groups, PackedBlocks,
                         ::testing::Values(std::pair(4, 0), std::pair(0, 9), std::pair(17, 6)));

TEST(PackedField, IsTheFieldOfTheTable) {
  const FieldTable table = random_table(17, 6, 13);
  const Vector c = random_vector(table.num_unknowns(), 1, 20);
  EXPECT_LT((PackedField(table).at(c) - evaluate_field(table, c)).cwiseAbs().maxCoeff(), 100 * kRounding);
}

}  // namespace
}  // namespace polyaffine
