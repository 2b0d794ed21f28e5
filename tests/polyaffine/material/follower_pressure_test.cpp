#include "polyaffine/material/follower_pressure.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <polyaffine/kinematics/lagrange.hpp>
#include <polyaffine/system/field_energy.hpp>

#include "support/labelled_box.hpp"
#include "support/matrix_system.hpp"
#include "support/random_vector.hpp"

namespace polyaffine {
namespace {

// The face z = 1 of a cube.
struct Face {
  TetMesh mesh = testing::labelled_cube(2, 0.1);
  LagrangeBasis basis{mesh, 2};
  FieldEnergy energy{surface_table(basis, basis.surface_points(mesh, {testing::kZHigh}, 4), Vec3::Zero()),
                     {std::make_shared<FollowerPressure>()}};
};

TEST(FollowerPressure, ForceIsTheAreaVectorOfTheTurnedAndStretchedFace) {
  const Face face;
  const Mat3 F =
      Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix() * Vec3(2, 0.5, 1.5).asDiagonal();
  const Points u = (F - Mat3::Identity()) * face.basis.nodes();
  const Vector force = face.energy.evaluate({u.reshaped()}).gradient;
  const Vec3 total = force.reshaped(3, face.basis.num_functions()).rowwise().sum();
  EXPECT_LT((total - F.col(0).cross(F.col(1))).norm(), 1e-12);
}

TEST(FollowerPressure, TangentIsTheSymmetricPartOfTheDerivative) {
  const Face face;
  const Vector c = testing::random_vector(face.energy.table().num_unknowns(), 0.1, 1);
  const Vector u = testing::random_vector(c.size(), 1, 2);
  const Vector v = testing::random_vector(c.size(), 1, 3);
  const double h = 1e-5;
  const auto derivative = [&](const Vector& a) -> Vector {
    return (face.energy.evaluate({c + h * a}).gradient - face.energy.evaluate({c - h * a}).gradient) /
           (2 * h);
  };
  const double symmetric = 0.5 * (v.dot(derivative(u)) + u.dot(derivative(v)));
  ASSERT_GT(std::abs(symmetric), 1e-2);
  EXPECT_NEAR(v.dot(testing::tangent(face.energy, {c}) * u), symmetric, 1e-8 * std::abs(symmetric));
}

}  // namespace
}  // namespace polyaffine
