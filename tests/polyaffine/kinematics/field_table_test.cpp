#include <gtest/gtest.h>

#include <polyaffine/check/derivative_check.hpp>
#include <polyaffine/kinematics/field_table.hpp>
#include <polyaffine/material/neo_hookean.hpp>
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

// Internal forces of a neo-Hookean solid in one block, by the block's own functions.
Vector block_force(const FieldTable& table, const PointBlock& block, const Vector& c) {
  const Matrix F = evaluate_field(table, c).middleCols(block.first, block.count);
  Matrix P = Matrix::Zero(9, block.count);
  NeoHookean({.lambda = 3, .mu = 2}).evaluate(0, block.count, F.data(), {}, nullptr, P.data(), nullptr);
  P = P * table.weights.segment(block.first, block.count).asDiagonal();
  Matrix force = Matrix::Zero(3, block.num_functions());
  add_field_transpose(block, P.data(), force);
  return force.reshaped();
}

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

TEST(FieldTable, StiffnessIsTheDerivativeOfTheForce) {
  const Mixed m;
  const PointBlock& block = m.table.blocks[2];
  const std::vector<int> functions = block.functions();
  ASSERT_EQ(functions, (std::vector<int>{1, 2, 0, 3}));  // plain ones first: the local numbering of K
  const auto to_global = [&](const Vector& local) {
    Vector c(12);
    for (std::size_t a = 0; a < functions.size(); ++a)
      c.segment<3>(3 * functions[a]) = local.segment<3>(static_cast<Eigen::Index>(3 * a));
    return c;
  };
  const auto force = [&](const Vector& local) { return block_force(m.table, block, to_global(local)); };
  const auto stiffness = [&](const Vector& local) {
    const Matrix F = evaluate_field(m.table, to_global(local)).middleCols(block.first, block.count);
    Matrix A = Matrix::Zero(81, block.count);
    NeoHookean({.lambda = 3, .mu = 2}).evaluate(0, block.count, F.data(), {}, nullptr, nullptr, A.data());
    A = A * m.table.weights.segment(block.first, block.count).asDiagonal();
    Matrix K;
    block_stiffness(block, A.data(), K);
    return K;
  };
  const Vector c = random_vector(12, 0.1, 5);
  const DerivativeReport report = check_jacobian(force, stiffness, c);
  EXPECT_TRUE(report.passed) << report.relative_error << " at " << report.worst_row << ", "
                             << report.worst_column;
  const Matrix K = stiffness(c);
  EXPECT_LT((K - K.transpose()).norm(), 1e-14 * K.norm());  // round-off of a sum over points
}

}  // namespace
}  // namespace polyaffine
