#include <gtest/gtest.h>

#include <polyaffine/core/error.hpp>
#include <polyaffine/kinematics/lagrange.hpp>
#include <polyaffine/system/field_energy.hpp>

#include "support/labelled_box.hpp"
#include "support/random_vector.hpp"

namespace polyaffine {
namespace {

constexpr double kKappa = 70;  // kPa

// A deformed mesh with its volumes, which the pressures must report.
struct Deformed {
  TetMesh mesh = testing::labelled_cube(2, 0.1);
  LagrangeBasis basis{mesh, 1};
  FieldTable table = deformation_table(basis, basis.wall_points(1));
  Vector c = testing::random_vector(table.num_unknowns(), 0.05, 1);
  TetMesh after{mesh.points() + Points(c.reshaped(3, mesh.num_points())), mesh.tets()};
};

TEST(PressureSpace, BlockPressureIsTheVolumeRatioOfEachElement) {
  const Deformed d;
  const FieldEnergy energy(d.table, {}, block_pressure(d.table, kKappa));
  const Vector p = energy.pressure(d.c);
  ASSERT_EQ(p.size(), d.mesh.num_tets());
  double W = 0;
  for (int t = 0; t < d.mesh.num_tets(); ++t) {
    const double dilatation = d.after.tet_volume(t) / d.mesh.tet_volume(t) - 1;
    EXPECT_NEAR(p[t], kKappa * dilatation, 1e-11 * kKappa);  // rounding of volumes of 0.02
    W += kKappa / 2 * d.mesh.tet_volume(t) * dilatation * dilatation;
  }
  EXPECT_GT(p.cwiseAbs().maxCoeff(), 1);
  EXPECT_NEAR(energy.evaluate({d.c}).value, W, 1e-12 * W);
}

TEST(PressureSpace, RegionPressureIsTheVolumeRatioOfEachRegion) {
  const Deformed d;
  std::vector<int> region;
  Eigen::Vector3d before = Vec3::Zero();
  Eigen::Vector3d after = Vec3::Zero();
  for (int t = 0; t < d.mesh.num_tets(); ++t) {
    region.push_back(t % 3);
    before[t % 3] += d.mesh.tet_volume(t);
    after[t % 3] += d.after.tet_volume(t);
  }
  const FieldEnergy energy(d.table, {}, region_pressure(d.table, region, 3, kKappa));
  const Vector p = energy.pressure(d.c);
  ASSERT_EQ(p.size(), 3);
  for (int r = 0; r < 3; ++r) EXPECT_NEAR(p[r], kKappa * (after[r] / before[r] - 1), 1e-11 * kKappa);
}

TEST(PressureSpace, DensePressureFindsADilatationThatLiesInItsSpace) {
  // u = (a x²/2, 0, 0): J − 1 = a x, which quadratic elements carry exactly.
  constexpr double kSlope = 0.3;
  const TetMesh mesh = testing::labelled_cube(2, 0.1);
  const LagrangeBasis basis(mesh, 2);
  const WallPoints points = basis.wall_points(4);
  const FieldTable table = deformation_table(basis, points);
  Matrix values = Matrix::Ones(3, table.num_points());
  for (int q = 0; q < table.num_points(); ++q) {
    const BasisSample s = basis.sample(points.tet[q], points.barycentric.col(q));
    values.col(q).tail(2) = (basis.nodes()(Eigen::all, s.functions) * s.N).head(2);
  }
  Points u = Points::Zero(3, basis.num_functions());
  u.row(0) = kSlope / 2 * basis.nodes().row(0).array().square();
  const FieldEnergy energy(table, {}, dense_pressure(table, values, kKappa));
  const Vector p = energy.pressure(u.reshaped());
  EXPECT_LT((p - kKappa * Vec3(0, kSlope, 0)).norm(), 1e-11 * kKappa);  // rounding
  // κ/2 ∫ a² x² = κ a²/6
  EXPECT_NEAR(energy.evaluate({u.reshaped()}).value, kKappa * kSlope * kSlope / 6, 1e-11);
}

TEST(PressureSpace, AFunctionWithoutPointsIsAnError) {
  const Deformed d;
  const std::vector<int> region(d.mesh.num_tets(), 1);  // regions 0 and 2 have no point
  EXPECT_THROW(FieldEnergy(d.table, {}, region_pressure(d.table, region, 3, kKappa)), ComputationError);
}

TEST(PressureSpace, DependentFunctionsAreAnError) {
  const Deformed d;
  Matrix values = Matrix::Ones(2, d.table.num_points());
  EXPECT_THROW(FieldEnergy(d.table, {}, dense_pressure(d.table, values, kKappa)), ComputationError);
  values.row(1) = testing::random_vector(values.cols(), 1, 2).transpose();
  EXPECT_NO_THROW(FieldEnergy(d.table, {}, dense_pressure(d.table, values, kKappa)));
}

}  // namespace
}  // namespace polyaffine
