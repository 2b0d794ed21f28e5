#include <gtest/gtest.h>

#include <stdexcept>

#include <polyaffine/quadrature/weight_conditions.hpp>

#include "polyaffine/kinematics/rotating_basis.hpp"
#include "support/labelled_box.hpp"
#include "support/random_regions.hpp"

namespace polyaffine {
namespace {

Vector relative_miss(const WeightConditions& c, const Vector& w) {
  return (c.A * w - c.b).cwiseAbs().cwiseQuotient(c.scale);
}

// Gauss points integrate the gradients of finite elements exactly, so the divergence theorem must come out.
TEST(IntegrationConstraint, HoldsForExactQuadratureOfFiniteElements) {
  const TetMesh mesh = testing::labelled_cube(3, 0.2);
  for (const int order : {1, 2}) {
    const LagrangeBasis basis(mesh, order);
    const FieldTable table = deformation_table(basis, basis.wall_points(order));
    const Points flux = boundary_integrals(basis, basis.surface_points(mesh, {1, 2, 3, 4, 5, 6}, order));
    const WeightConditions constraint = integration_constraint(table, flux);
    EXPECT_LT(relative_miss(constraint, table.weights).maxCoeff(), 1e-13);
    Vector uneven = table.weights;
    uneven[uneven.size() / 2] *= 1.5;
    EXPECT_GT(relative_miss(constraint, uneven).maxCoeff(), 1e-2);
  }
}

// One point a region of integration, weighted by its volume: the paper's rule.
TEST(IntegrationConstraint, IsMissedByVolumesOfRandomRegions) {
  const testing::RandomRegions scene(4, 60, 3);
  const WeightConditions constraint = integration_constraint(
      deformation_table(*scene.basis, scene.points()), boundary_integrals(*scene.basis, scene.boundary()));
  EXPECT_GT(relative_miss(constraint, scene.integration.points.weights).maxCoeff(), 1e-3);
}

TEST(RegionMoments, HoldForGaussPointsAndNotForOneOffCentre) {
  const testing::RandomRegions scene(3, 20, 5);
  const WallPoints gauss = scene.geometry->wall_points(1);
  const QuadraturePoints points{gauss.tet, gauss.barycentric, gauss.weights};
  const WeightConditions moments =
      region_moments(scene.mesh, scene.label, 3, gauss.tet, positions(scene.mesh, points));
  EXPECT_EQ(moments.b.size(), 12);
  EXPECT_LT(relative_miss(moments, gauss.weights).maxCoeff(), 1e-14);
  Vector uneven = gauss.weights;
  uneven[0] *= 2;
  EXPECT_GT(relative_miss(moments, uneven).maxCoeff(), 1e-3);
}

TEST(IntegrationConstraint, RejectsLocalAxes) {
  const testing::RotatingBasis basis;
  const FieldTable table = deformation_table(basis, basis.space().wall_points(1));
  EXPECT_THROW(integration_constraint(table, Points::Zero(3, 4)), std::invalid_argument);
  const TetMesh& mesh = basis.mesh();
  EXPECT_THROW(boundary_integrals(basis, basis.space().surface_points(mesh, mesh.boundary_labels(), 1)),
               std::invalid_argument);
}

TEST(WeightConditions, RejectDifferentPoints) {
  const WeightConditions two{Matrix::Ones(1, 2), Vector::Ones(1), Vector::Ones(1)};
  const WeightConditions three{Matrix::Ones(1, 3), Vector::Ones(1), Vector::Ones(1)};
  EXPECT_THROW(stack(two, three), std::invalid_argument);
  EXPECT_EQ(stack(two, two).A.rows(), 2);
}

}  // namespace
}  // namespace polyaffine
