#include "polyaffine/fields/laplace.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include <polyaffine/core/error.hpp>

#include "support/convergence.hpp"
#include "support/labelled_box.hpp"

namespace polyaffine {
namespace {

const std::vector<int> kAllFaces{1, 2, 3, 4, 5, 6};

template <class Field>
Vector solve(const LagrangeBasis& basis, const TetMesh& mesh, const std::vector<int>& faces,
             const Field& exact) {
  std::vector<NodeValue> values;
  for (const int n : basis.surface_nodes(mesh, faces))
    values.push_back({n, exact(Vec3(basis.nodes().col(n)))});
  return solve_laplace(basis, values);
}

class Laplace : public ::testing::TestWithParam<int> {};

TEST_P(Laplace, LinearFieldsAreExact) {
  const TetMesh mesh = testing::labelled_cube(3, 0.25);
  const LagrangeBasis basis(mesh, GetParam());
  const auto linear = [](const Vec3& X) { return 1 + 2 * X.x() - X.y() + 0.5 * X.z(); };
  const Vector psi = solve(basis, mesh, kAllFaces, linear);
  for (int n = 0; n < basis.num_functions(); ++n) EXPECT_NEAR(psi[n], linear(basis.nodes().col(n)), 1e-12);
  // Values on two faces only: no flux through the others.
  const auto along = [](const Vec3& X) { return 3 - X.z(); };
  const Vector column = solve(basis, mesh, {testing::kZLow, testing::kZHigh}, along);
  for (int n = 0; n < basis.num_functions(); ++n) EXPECT_NEAR(column[n], along(basis.nodes().col(n)), 1e-11);
}

TEST_P(Laplace, ConvergesWithTheOrderOfTheElements) {
  const auto harmonic = [](const Vec3& X) {
    return std::exp(2 * X.x()) * std::sin(2 * X.y()) + X.y() * X.z();
  };
  const auto error = [&](int n) {
    const TetMesh mesh = testing::labelled_cube(n);
    const LagrangeBasis basis(mesh, GetParam());
    const Vector psi = solve(basis, mesh, kAllFaces, harmonic);
    return testing::l2_error(basis, psi.transpose(),
                             [&](const Vec3& X) { return Vector::Constant(1, harmonic(X)); });
  };
  const double coarse = error(2);
  const double middle = error(4);
  const double fine = error(8);
  EXPECT_GT(testing::order(coarse, middle), GetParam() + 0.6);  // not yet asymptotic
  EXPECT_NEAR(testing::order(middle, fine), GetParam() + 1, 0.2);
}

INSTANTIATE_TEST_SUITE_P(Order, Laplace, ::testing::Values(1, 2));

TEST(Laplace, WithoutValuesThereIsNoSolution) {
  const LagrangeBasis basis(testing::labelled_cube(1), 1);
  EXPECT_THROW(solve_laplace(basis, {}), ComputationError);
}

// In one dimension w ψ' is constant: with w = 1/(1 + x) the solution between 0 and 1 is (x + x²/2)/1.5.
TEST(Diffusion, FollowsTheConductivity) {
  const TetMesh mesh = testing::labelled_cube(4);
  const LagrangeBasis basis(mesh, 2);
  const WallPoints points = basis.wall_points(4);
  std::vector<NodeValue> values;
  for (const int n : basis.surface_nodes(mesh, {testing::kZLow})) values.push_back({n, 0.0});
  for (const int n : basis.surface_nodes(mesh, {testing::kZHigh})) values.push_back({n, 1.0});
  const Vector psi = solve_diffusion(
      basis, points,
      [&](std::size_t q) {
        const double z =
            basis.position(points.tet[q], points.barycentric.col(static_cast<Eigen::Index>(q))).z();
        return DiffusionPoint{Mat3::Identity() / (1 + z)};
      },
      values);
  for (int n = 0; n < basis.num_functions(); ++n) {
    const double z = basis.nodes()(2, n);
    EXPECT_NEAR(psi[n], (z + z * z / 2) / 1.5, 1e-4);
  }
}

// The cone f = |X|: f ψ with ψ = 1 is harmonic under D = I/f² (its flux X/f³ has no source), exactly so.
TEST(Diffusion, AFactorTakesOutWhatPolynomialsFollowBadly) {
  const TetMesh mesh = testing::labelled_cube(3);
  const LagrangeBasis basis(mesh, 2);
  const WallPoints points = basis.wall_points(6);
  const Vec3 tip(-0.5, -0.5, -0.5);
  std::vector<NodeValue> values;
  for (const int n : basis.surface_nodes(mesh, kAllFaces)) values.push_back({n, 1.0});
  const Vector psi = solve_diffusion(
      basis, points,
      [&](std::size_t q) {
        const Vec3 d =
            basis.position(points.tet[q], points.barycentric.col(static_cast<Eigen::Index>(q))) - tip;
        const double f = d.norm();
        return DiffusionPoint{Mat3::Identity() / (f * f), f, d / f};
      },
      values);
  for (int n = 0; n < basis.num_functions(); ++n) EXPECT_NEAR(psi[n], 1, 2e-4);
}

}  // namespace
}  // namespace polyaffine
