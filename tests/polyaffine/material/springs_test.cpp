#include <gtest/gtest.h>

#include <polyaffine/check/derivative_check.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/kinematics/lagrange.hpp>
#include <polyaffine/material/springs.hpp>
#include <polyaffine/system/field_energy.hpp>

#include "support/labelled_box.hpp"
#include "support/matrix_system.hpp"
#include "support/random_vector.hpp"

namespace polyaffine {
namespace {

// The face z = high of a 2 × 3 × 1 box, area 6 mm².
struct Face {
  TetMesh mesh = testing::labelled_box(Vec3::Zero(), Vec3(2, 3, 1), {2, 2, 1}, 0.1);
  LagrangeBasis basis{mesh, 2};
  SurfacePoints points = basis.surface_points(mesh, {testing::kZHigh}, 4);

  FieldEnergy energy(std::shared_ptr<const Law> law) const {
    return FieldEnergy(displacement_table(basis, points), {std::move(law)});
  }
  Vector uniform(const Vec3& u) const { return u.replicate(1, basis.num_functions()).reshaped(); }
};

constexpr double kArea = 6;
constexpr double kStiffness = 4;  // kPa/mm

TEST(Springs, EnergyOfAUniformDisplacement) {
  const Face face;
  const Vec3 u(0.2, -0.3, 0.5);
  const FieldEnergy all = face.energy(std::make_shared<SurfaceSpring>(kStiffness));
  EXPECT_NEAR(all.evaluate({face.uniform(u)}).value, kStiffness / 2 * u.squaredNorm() * kArea, 1e-12);
  const Points normals = Vec3(0, 0.6, 0.8).replicate(1, face.points.X.cols());
  const FieldEnergy normal = face.energy(std::make_shared<SurfaceSpring>(kStiffness, normals));
  EXPECT_NEAR(normal.evaluate({face.uniform(u)}).value, kStiffness / 2 * 0.22 * 0.22 * kArea, 1e-12);
  EXPECT_LT(normal.evaluate({face.uniform(Vec3(1, 0.8, -0.6))}).gradient.norm(), 1e-12);  // slides along
}

TEST(Springs, AcrossNormalsIsTheRest) {
  const Face face;
  const Points normals = Vec3(0, 0.6, 0.8).replicate(1, face.points.X.cols());
  const FieldEnergy across =
      face.energy(std::make_shared<SurfaceSpring>(kStiffness, normals, SpringDirection::across_normal));
  const Vec3 u(0.2, -0.3, 0.5);  // 0.22 along the normal
  EXPECT_NEAR(across.evaluate({face.uniform(u)}).value,
              kStiffness / 2 * (u.squaredNorm() - 0.22 * 0.22) * kArea, 1e-12);
  EXPECT_LT(across.evaluate({face.uniform(Vec3(0, 0.6, 0.8))}).gradient.norm(), 1e-12);
}

TEST(Springs, DerivativesMatchFiniteDifferences) {
  const Face face;
  Points normals(3, face.points.X.cols());
  for (Eigen::Index q = 0; q < normals.cols(); ++q)
    normals.col(q) = testing::random_vector(3, 1, static_cast<unsigned>(q)).normalized();
  for (const FieldEnergy& energy : {face.energy(std::make_shared<SurfaceSpring>(kStiffness)),
                                    face.energy(std::make_shared<SurfaceSpring>(kStiffness, normals)),
                                    face.energy(std::make_shared<DeadTraction>(Vec3(1, -2, 3)))}) {
    const Vector c = testing::random_vector(energy.table().num_unknowns(), 0.5, 3);
    const auto gradient = [&](const Vector& x) { return energy.evaluate({x}).gradient; };
    EXPECT_TRUE(
        check_gradient([&](const Vector& x) { return energy.evaluate({x}).value; }, gradient, c).passed);
  }
  for (const FieldEnergy& energy : {face.energy(std::make_shared<SurfaceSpring>(kStiffness)),
                                    face.energy(std::make_shared<SurfaceSpring>(kStiffness, normals))}) {
    const Vector c = testing::random_vector(energy.table().num_unknowns(), 0.5, 4);
    const auto gradient = [&](const Vector& x) { return energy.evaluate({x}).gradient; };
    EXPECT_TRUE(check_jacobian(
                    gradient, [&](const Vector& x) { return testing::tangent(energy, {x}); }, c)
                    .passed);
  }
}

TEST(Springs, DeadTractionPullsWithItsForceAndHasNoStiffness) {
  const Face face;
  const Vec3 traction(1, -2, 3);
  const FieldEnergy energy = face.energy(std::make_shared<DeadTraction>(traction));
  const Vector c = testing::random_vector(energy.table().num_unknowns(), 0.5, 5);
  const EnergyValue at = energy.evaluate({c});
  const Vec3 total = at.gradient.reshaped(3, face.basis.num_functions()).rowwise().sum();
  EXPECT_LT((total + kArea * traction).norm(), 1e-12);
  EXPECT_EQ(testing::tangent(energy, {c}).norm(), 0);
}

TEST(Springs, AStiffnessThatIsNotPositiveIsAnError) {
  EXPECT_THROW(SurfaceSpring(0.0), InputError);
  EXPECT_THROW(SurfaceSpring(-1.0), InputError);
}

}  // namespace
}  // namespace polyaffine
