#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>

#include <polyaffine/kinematics/lagrange.hpp>
#include <polyaffine/kinematics/resultant_table.hpp>
#include <polyaffine/material/springs.hpp>
#include <polyaffine/system/field_energy.hpp>

#include "polyaffine/kinematics/rotating_basis.hpp"
#include "support/labelled_box.hpp"
#include "support/matrix_system.hpp"

namespace polyaffine {
namespace {

TEST(ResultantTable, CarriesADeadLoadOnAFace) {
  const TetMesh mesh = testing::labelled_cube(3, 0.2);
  const LagrangeBasis basis(mesh, 2);
  const FieldTable face = displacement_table(basis, basis.surface_points(mesh, {testing::kZHigh}, 3));
  const std::vector<std::shared_ptr<const Law>> load{std::make_shared<DeadTraction>(Vec3(1, 2, 3))};
  const FieldEnergy whole(face, load), lumped(resultant_table(face), load);
  EXPECT_EQ(lumped.table().num_points(), 1);
  const Vector c = testing::random_vector(face.num_unknowns(), 1, 3);
  const EnergyValue expected = whole.evaluate({c}), found = lumped.evaluate({c});
  EXPECT_GT(expected.gradient.norm(), 0.1);
  EXPECT_NEAR(found.value, expected.value, 1e-13);
  EXPECT_LT((found.gradient - expected.gradient).norm(), 1e-14);
  EXPECT_EQ(testing::tangent(lumped, {c}).norm(), 0);
}

TEST(ResultantTable, KeepsTheBase) {
  const TetMesh mesh = testing::labelled_cube(2);
  const LagrangeBasis basis(mesh, 1);
  const FieldTable wall = deformation_table(basis, basis.wall_points(1));
  const Vector c = testing::random_vector(wall.num_unknowns(), 1, 4);
  EXPECT_LT((evaluate_field(resultant_table(wall), c) - evaluate_field(wall, c) * wall.weights).norm(),
            1e-13);
}

TEST(ResultantTable, RejectsLocalAxes) {
  const testing::RotatingBasis basis;
  EXPECT_THROW(resultant_table(deformation_table(basis, basis.space().wall_points(1))),
               std::invalid_argument);
}

}  // namespace
}  // namespace polyaffine
