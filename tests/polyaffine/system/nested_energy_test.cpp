#include <gtest/gtest.h>

#include <memory>

#include <polyaffine/check/derivative_check.hpp>
#include <polyaffine/kinematics/nested_basis.hpp>
#include <polyaffine/material/follower_pressure.hpp>
#include <polyaffine/material/neo_hookean.hpp>
#include <polyaffine/material/signed_volume.hpp>
#include <polyaffine/material/viscosity.hpp>
#include <polyaffine/system/field_energy.hpp>

#include "support/labelled_box.hpp"
#include "support/matrix_system.hpp"
#include "support/random_vector.hpp"

namespace polyaffine {
namespace {

using testing::random_vector;
using testing::tangent;

constexpr int kScalar = 5;                // scalar functions
constexpr double kMu = 10, kKappa = 200;  // kPa
constexpr double kRounding = 1e-10;       // of a sum over some hundred points

// Quadratic elements of a box and functions nested in them: five scalar ones, each by random values at some
// of the nodes, and six random modes.
struct Nested {
  TetMesh mesh = testing::labelled_box(Vec3::Zero(), Vec3(2, 1, 1), {2, 1, 1});
  std::shared_ptr<const LagrangeBasis> elements = std::make_shared<LagrangeBasis>(mesh, 2);
  std::shared_ptr<const NestedBasis> basis = [this] {
    const int nodes = elements->num_functions();
    const Vector values = random_vector(nodes * kScalar, 1, 7);
    NodalFunctions functions(nodes, kScalar);
    for (int node = 0; node < nodes; ++node)
      for (int f = 0; f < kScalar; ++f)
        if ((node + f) % 3 != 0) functions.insert(node, f) = values[node * kScalar + f];
    const Matrix modes = random_vector(3 * nodes * 6, 1, 8).reshaped(3 * nodes, 6);
    return std::make_shared<NestedBasis>(elements, functions, modes);
  }();

  Vector coefficients(double size, unsigned seed) const {
    return random_vector(3 * basis->num_functions(), size, seed);
  }
};

// Viscous, with one pressure an element.
FieldEnergy wall(const Basis& basis, const LagrangeBasis& elements) {
  FieldTable table = deformation_table(basis, elements.wall_points(3));
  const PressureSpace pressure = block_pressure(table, kKappa);
  return FieldEnergy(std::move(table),
                     {std::make_shared<IsochoricNeoHookean>(kMu), std::make_shared<KelvinVoigt>(3.0)},
                     pressure);
}

TEST(NestedEnergy, IsTheProjectionOfTheElements) {
  const Nested nested;
  const FieldEnergy full = wall(*nested.elements, *nested.elements);
  const FieldEnergy reduced = wall(*nested.basis, *nested.elements);
  const Vector c = nested.coefficients(0.02, 1), rate = nested.coefficients(0.1, 2);
  const Vector u = nested.basis->nodal(c), u_rate = nested.basis->nodal(rate);
  const EnergyValue expected = full.evaluate({u, {}, &u_rate}), found = reduced.evaluate({c, {}, &rate});
  ASSERT_GT(expected.min_det, 0.2);
  EXPECT_NEAR(found.value, expected.value, kRounding * std::abs(expected.value));
  EXPECT_NEAR(found.min_det, expected.min_det, kRounding);
  const Vector force = nested.basis->transpose(expected.gradient);
  ASSERT_GT(force.norm(), 0);
  EXPECT_LT((found.gradient - force).norm(), kRounding * force.norm());
  const Matrix K = tangent(full, {u});
  const Matrix projected = nested.basis->transpose(nested.basis->transpose(K).transpose());
  EXPECT_LT((tangent(reduced, {c}) - projected).norm(), kRounding * projected.norm());
}

TEST(NestedEnergy, GradientAndTangentMatchFiniteDifferences) {
  const Nested nested;
  const FieldEnergy energy = wall(*nested.basis, *nested.elements);
  const Vector c = nested.coefficients(0.02, 3);
  const auto gradient = [&](const Vector& x) { return energy.evaluate({x}).gradient; };
  const auto value = [&](const Vector& x) { return energy.evaluate({x}).value; };
  EXPECT_TRUE(check_gradient(value, gradient, c).passed);
  EXPECT_TRUE(check_jacobian(
                  gradient, [&](const Vector& x) { return tangent(energy, {x}); }, c)
                  .passed);
}

TEST(NestedEnergy, VolumeGradientIsThatOfEachPressure) {
  const Nested nested;
  const FieldEnergy energy = wall(*nested.basis, *nested.elements);
  const Vector c = nested.coefficients(0.02, 11), p = random_vector(nested.mesh.num_tets(), 5, 12);
  const VolumeGradient D = energy.volume_gradient(c);
  const auto force_of = [&](const Vector& pressure) {
    return energy.evaluate({c, {}, nullptr, &pressure}).gradient;
  };
  const Vector force = force_of(p) - force_of(Vector::Zero(p.size()));
  ASSERT_GT(force.norm(), 0);
  EXPECT_LT((D.transpose_times(p) - force).norm(), kRounding * force.norm());
  const Vector u = nested.coefficients(1, 13);
  EXPECT_NEAR(p.dot(Vector(D.times(u))), u.dot(force), kRounding * u.norm() * force.norm());
}

TEST(NestedEnergy, PointsAddUpToTheForce) {
  const Nested nested;
  const FieldEnergy energy = wall(*nested.basis, *nested.elements);
  const Vector c = nested.coefficients(0.02, 4);
  const Vector pressure = random_vector(nested.mesh.num_tets(), 5, 5);
  const Motion motion{c, {}, nullptr, &pressure};
  const Vector force = energy.evaluate(motion).gradient;
  EXPECT_LT((energy.point_terms(motion).gradient.rowwise().sum() - force).norm(), kRounding * force.norm());
}

TEST(NestedEnergy, SurfacesFollowTheElements) {
  const Nested nested;
  const SurfacePoints points = nested.elements->surface_points(nested.mesh, {1}, 4);
  const auto volume = [&](const Basis& basis) {
    return FieldEnergy(surface_table(basis, points, Vec3(1, 1, 1)),
                       {std::make_shared<SignedVolume>(1.0 / 3)});
  };
  const Vector c = nested.coefficients(0.02, 6);
  const EnergyValue full = volume(*nested.elements).evaluate({nested.basis->nodal(c)}),
                    reduced = volume(*nested.basis).evaluate({c});
  EXPECT_NEAR(reduced.value, full.value, kRounding * std::abs(full.value));
  const Vector force = nested.basis->transpose(full.gradient);
  EXPECT_LT((reduced.gradient - force).norm(), kRounding * force.norm());
}

TEST(NestedEnergy, DisplacementMapIsThatOfTheElements) {
  const Nested nested;
  const WallPoints at = nested.elements->wall_points(2);
  const DisplacementMap full(*nested.elements, at.tet, at.barycentric),
      reduced(*nested.basis, at.tet, at.barycentric);
  const Vector c = nested.coefficients(0.1, 9);
  const Points u = full.apply(nested.basis->nodal(c));
  EXPECT_LT((reduced.apply(c) - u).norm(), kRounding * u.norm());
  const Points forces = random_vector(static_cast<int>(u.size()), 1, 10).reshaped(3, u.cols());
  const Vector expected = nested.basis->transpose(full.transpose(forces));
  EXPECT_LT((reduced.transpose(forces) - expected).norm(), kRounding * expected.norm());
}

TEST(NestedBasis, TellsManyFieldsAsEachByItself) {
  const Nested nested;
  Matrix c(3 * nested.basis->num_functions(), 3);
  for (Eigen::Index k = 0; k < c.cols(); ++k)
    c.col(k) = nested.coefficients(0.1, 20 + static_cast<unsigned>(k));
  const Matrix u = nested.basis->nodal_of_each(c);
  ASSERT_EQ(u.cols(), c.cols());
  for (Eigen::Index k = 0; k < c.cols(); ++k) {
    const Vector alone = nested.basis->nodal(c.col(k));
    EXPECT_GT(alone.norm(), 0.1);
    EXPECT_LT((u.col(k) - alone).norm(), kRounding * alone.norm());
  }
}

TEST(NestedBasis, RefusesModesThatDoNotFit) {
  const Nested nested;
  EXPECT_THROW(NestedBasis(nested.elements, nested.basis->functions(), Matrix(3, 3)), std::invalid_argument);
  EXPECT_THROW(NestedBasis(nested.elements, nested.basis->functions(), nested.basis->modes().leftCols(4)),
               std::invalid_argument);
}

}  // namespace
}  // namespace polyaffine
