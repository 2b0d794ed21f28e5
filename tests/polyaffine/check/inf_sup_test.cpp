#include "polyaffine/check/inf_sup.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include <polyaffine/core/error.hpp>
#include <polyaffine/kinematics/lagrange.hpp>

#include "support/labelled_box.hpp"

namespace polyaffine {
namespace {

// A box of tets; the faces x = 0, y = 0, z = 0 are held along their normals, or the first one entirely.
struct Box {
  TetMesh mesh = testing::labelled_box(Vec3::Zero(), Vec3(2, 1, 1), {3, 2, 2}, 0.2);
  LagrangeBasis basis;
  FieldTable table;
  std::vector<char> fixed;

  Box(int order, bool clamped)
      : basis(mesh, order),
        table(deformation_table(basis, basis.wall_points(order == 1 ? 1 : 3))),
        fixed(table.num_unknowns(), 0) {
    const int faces[] = {testing::kXLow, testing::kYLow, testing::kZLow};
    for (int k = 0; k < 3; ++k)
      for (const int node : basis.surface_nodes(mesh, {faces[clamped ? 0 : k]})) fixed[3 * node + k] = 1;
  }
  InfSup with(const PressureSpace& space) const { return inf_sup(table, space, fixed); }
};

// A uniform pressure works on div u ≤ √3 |ε|, with equality for u = X.
TEST(InfSup, OfOnePressureIsThatOfAUniformSwelling) {
  const Box box(2, false);
  const InfSup found =
      box.with(region_pressure(box.table, std::vector<int>(box.table.num_points(), 0), 1, 10));
  ASSERT_EQ(found.pressures, 1);
  EXPECT_NEAR(found.beta(), std::sqrt(3.0), 1e-10);
  EXPECT_EQ(found.spurious, 0);
}

TEST(InfSup, DoesNotDependOnTheScaleOfPressures) {
  const Box box(2, true);
  const auto scaled = [&](double factor) {
    PressureSpace space = block_pressure(box.table, 10);
    for (std::size_t k = 0; k < space.blocks.size(); ++k) space.blocks[k].values *= k % 2 == 0 ? factor : 1;
    return box.with(space).singular_values;
  };
  const Vector one = scaled(1), seven = scaled(7);
  EXPECT_LT((seven - one).norm(), 1e-10 * one.norm());
  EXPECT_LE(one.maxCoeff(), std::sqrt(3.0) * (1 + 1e-12));
}

TEST(InfSup, QuadraticTetsControlOnePressureEachAndLinearOnesDoNot) {
  const Box quadratic(2, true), linear(1, true);
  const InfSup stable = quadratic.with(block_pressure(quadratic.table, 10));
  EXPECT_EQ(stable.spurious, 0);
  EXPECT_GT(stable.beta(), 0.2);  // bounded below on every mesh (Boffi, Brezzi & Fortin 2013, §8.6)
  const InfSup locked = linear.with(block_pressure(linear.table, 10));
  EXPECT_LT(locked.displacements, stable.displacements);
  ASSERT_EQ(locked.pressures, linear.mesh.num_tets());
  ASSERT_EQ(locked.singular_values.size(), locked.pressures);
  // 81 unknowns cannot determine 72 pressures and still leave the box free to move.
  EXPECT_LT(locked.beta(), 0.3 * stable.beta());
}

TEST(InfSup, CountsPressuresThatNoDisplacementFeels) {
  const Box box(1, true);
  // one pressure a point, and a second one at each that lives where the first does not suffice
  Matrix values(2 * box.mesh.num_tets(), 4 * box.mesh.num_tets());
  const FieldTable table = deformation_table(box.basis, box.basis.wall_points(2));
  values.setZero(values.rows(), table.num_points());
  for (int t = 0; t < box.mesh.num_tets(); ++t) {
    const auto& block = table.blocks[t];
    values.block(2 * t, block.first, 1, block.count).setOnes();
    values(2 * t + 1, block.first) = 1;
  }
  const InfSup found = inf_sup(table, dense_pressure(table, values, 10), box.fixed);
  // The divergence of linear functions is constant in a tet.
  EXPECT_GE(found.spurious, box.mesh.num_tets());
  EXPECT_GE(found.spurious, found.pressures - found.displacements);
}

TEST(InfSup, RefusesAMotionWithoutStrain) {
  const Box box(2, true);
  EXPECT_THROW(inf_sup(box.table, block_pressure(box.table, 10)), ComputationError);
}

}  // namespace
}  // namespace polyaffine
