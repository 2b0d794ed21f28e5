#include <gtest/gtest.h>

#include <polyaffine/kinematics/field_table.hpp>
#include "rotating_basis.hpp"

namespace polyaffine {
namespace {

using testing::random_vector;
using testing::RotatingBasis;

struct Mixed {
  RotatingBasis basis;
  WallPoints points = basis.space().wall_points(2);
  FieldTable table = deformation_table(basis, points);
};

TEST(FieldTable, GivesTheGradientOfALinearMap) {
  const RotatingBasis scene;
  const LagrangeBasis& space = scene.space();
  const FieldTable table = deformation_table(space, space.wall_points(1));
  Mat3 F;
  F << 1.2, 0.3, -0.1, 0.05, 0.9, 0.2, -0.3, 0.1, 1.1;
  const Points u = (F - Mat3::Identity()) * space.nodes();
  const Matrix field = evaluate_field(table, u.reshaped());
  ASSERT_EQ(field.cols(), 6);
  // Round-off of a few products of order one.
  for (Eigen::Index q = 0; q < field.cols(); ++q) EXPECT_LT((field.col(q) - F.reshaped()).norm(), 1e-13);
}

TEST(FieldTable, HasAnExactTranspose) {
  const Mixed m;
  for (const auto& block : m.table.blocks) {
    ASSERT_EQ(block.groups.size(), 2U);  // plain and lifted
    const Vector c = random_vector(12, 1, 3);
    const Vector S = random_vector(9 * block.count, 1, 4);
    Matrix field = Matrix::Zero(9, block.count);
    add_field(block, gather(block, c), field.data());
    Matrix force = Matrix::Zero(3, block.num_functions());
    add_field_transpose(block, S.data(), force);
    const double forward = S.dot(Vector(field.reshaped()));
    EXPECT_NEAR(forward, force.reshaped().dot(gather(block, c).reshaped()), 1e-13);
    EXPECT_GT(std::abs(forward), 1e-2);
  }
}

// Few points are summed one by one, many by products of matrices.
TEST(FieldTable, IsTheSameForFewAndForManyPoints) {
  const RotatingBasis scene;
  const LagrangeBasis& space = scene.space();
  const Vector c = random_vector(3 * space.num_functions(), 0.1, 5);
  for (const int degree : {1, 3}) {
    const FieldTable table = deformation_table(space, space.wall_points(degree));
    const Matrix field = evaluate_field(table, c);
    for (const PointBlock& block : table.blocks) {
      Matrix expected(9, block.count);
      expected.colwise() = Mat3::Identity().reshaped();
      add_field(block, gather(block, c), expected.data());
      EXPECT_GT((expected.colwise() - Mat3::Identity().reshaped()).norm(), 1e-3);
      EXPECT_LT((field.middleCols(block.first, block.count) - expected).norm(), 1e-13);
    }
  }
}

}  // namespace
}  // namespace polyaffine
