#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <polyaffine/kinematics/basis.hpp>
#include <polyaffine/material/signed_volume.hpp>
#include <polyaffine/system/field_energy.hpp>
#include "rotating_basis.hpp"

namespace polyaffine {
namespace {

using testing::random_vector;
using testing::RotatingBasis;

constexpr double kStep = 1e-5;  // of central differences: errors of step² times third derivatives

TEST(DeformationTable, InLocalAxesIsTheGradientOfTheDisplacement) {
  const RotatingBasis basis;
  const WallPoints points = basis.space().wall_points(2);
  const FieldTable table = deformation_table(basis, points);
  const Vector c = random_vector(12, 1, 1);
  const Matrix field = evaluate_field(table, c);
  double largest = 0;
  for (Eigen::Index q = 0; q < field.cols(); ++q) {
    const Vec3 X = basis.space().nodes()(Eigen::all, basis.space().elements().col(points.tet[q])) *
                   points.barycentric.col(q);
    const Mat3 F = field.col(q).reshaped(3, 3);
    for (int J = 0; J < 3; ++J) {
      const Vec3 h = kStep * Vec3::Unit(J);
      const Vec3 slope =
          (RotatingBasis::displacement(X + h, c) - RotatingBasis::displacement(X - h, c)) / (2 * kStep);
      EXPECT_LT((F.col(J) - Vec3::Unit(J) - slope).norm(), 1e-8);
    }
    largest = std::max(largest, (F - Mat3::Identity()).norm());
  }
  EXPECT_GT(largest, 0.5);
}

TEST(SurfaceTable, InLocalAxesCarriesPositionAndTangents) {
  const RotatingBasis basis;
  const SurfacePoints points = basis.space().surface_points(basis.mesh(), {TetMesh::kUnlabelled}, 2);
  const Vec3 origin(0.3, -0.2, 0.7);
  const Vector c = random_vector(12, 1, 2);
  const Matrix field = evaluate_field(surface_table(basis, points, origin), c);
  for (Eigen::Index q = 0; q < field.cols(); ++q) {
    const Vec3 X = points.X.col(q);
    // Round-off of a few products of order one.
    EXPECT_LT((field.col(q).head<3>() - (X + RotatingBasis::displacement(X, c) - origin)).norm(), 1e-13);
    for (const auto& [tangent, row] : {std::pair(&points.X_xi, 3), std::pair(&points.X_eta, 6)}) {
      const Vec3 T = tangent->col(q);
      const Vec3 slope =
          (RotatingBasis::displacement(X + kStep * T, c) - RotatingBasis::displacement(X - kStep * T, c)) /
          (2 * kStep);
      EXPECT_LT((field.col(q).segment<3>(row) - T - slope).norm(), 1e-8);
    }
  }
}

TEST(SurfaceTable, IntegratesToTheVolumeOfTheDeformedCube) {
  const RotatingBasis scene;
  const LagrangeBasis& space = scene.space();
  const SurfacePoints points = space.surface_points(scene.mesh(), {TetMesh::kUnlabelled}, 2);
  Mat3 F;
  F << 1.5, 0.3, 0, 0.1, 0.8, -0.2, 0, 0.4, 2;
  const Vector c = Points((F - Mat3::Identity()) * space.nodes()).reshaped();
  for (const Vec3& origin : {Vec3(0, 0, 0), Vec3(3, -1, 2)}) {
    const FieldEnergy volume(surface_table(space, points, origin), {std::make_shared<SignedVolume>(1.0 / 3)});
    EXPECT_NEAR(volume.evaluate({Vector::Zero(c.size())}).value, 1, 1e-13);
    EXPECT_NEAR(volume.evaluate({c}).value, F.determinant(), 1e-13);
  }
}

TEST(DisplacementTable, WeighsByArea) {
  const RotatingBasis basis;
  const SurfacePoints points = basis.space().surface_points(basis.mesh(), {TetMesh::kUnlabelled}, 2);
  const FieldTable table = displacement_table(basis, points);
  EXPECT_NEAR(table.weights.sum(), 6, 1e-13);
  const Vector c = random_vector(12, 1, 6);
  const Matrix field = evaluate_field(table, c);
  for (Eigen::Index q = 0; q < field.cols(); ++q) {
    EXPECT_LT((field.col(q).head<3>() - RotatingBasis::displacement(points.X.col(q), c)).norm(), 1e-13);
    EXPECT_EQ(field.col(q).tail<6>().norm(), 0);
  }
}

TEST(DisplacementMap, GivesTheDisplacementAndItsExactTranspose) {
  const RotatingBasis basis;
  const WallPoints points = basis.space().wall_points(2);
  const DisplacementMap map(basis, points.tet, points.barycentric);
  const Vector c = random_vector(12, 1, 7);
  const Points u = map.apply(c);
  for (Eigen::Index q = 0; q < u.cols(); ++q) {
    const Vec3 X = basis.space().nodes()(Eigen::all, basis.space().elements().col(points.tet[q])) *
                   points.barycentric.col(q);
    EXPECT_LT((u.col(q) - RotatingBasis::displacement(X, c)).norm(), 1e-13);
  }
  const Points f = random_vector(u.size(), 1, 8).reshaped(3, u.cols());
  const double work = f.cwiseProduct(u).sum();
  EXPECT_NEAR(map.transpose(f).dot(c), work, 1e-12);
  EXPECT_GT(std::abs(work), 1e-2);
}

}  // namespace
}  // namespace polyaffine
