#include "polyaffine/geometry/laplace.hpp"

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
  for (int n = 0; n < basis.num_functions(); ++n) EXPECT_NEAR(column[n], along(basis.nodes().col(n)), 1e-12);
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

// The projection solves f − ℓ² Δf = g without flux through the boundary.
struct Projection {
  TetMesh mesh = testing::labelled_cube(6);
  LagrangeBasis basis{mesh, 2};
  WallPoints points = basis.wall_points(4);

  template <class Field>
  Matrix operator()(const Field& g, double length) const {
    Matrix values(g(Vec3::Zero()).size(), points.barycentric.cols());
    for (Eigen::Index q = 0; q < values.cols(); ++q) {
      const BasisSample s = basis.sample(points.tet[q], points.barycentric.col(q));
      values.col(q) = g(basis.nodes()(Eigen::all, s.functions) * s.N);
    }
    return smooth_projection(basis, points, values, length);
  }
};

TEST(SmoothProjection, KeepsConstantsAtAnyLength) {
  const Projection project;
  const Vec3 value(1, -2, 0.5);
  for (const double length : {0.0, 0.1, 3.0}) {
    const Matrix f = project([&](const Vec3&) { return Vector(value); }, length);
    EXPECT_LT((f.colwise() - Vector(value)).cwiseAbs().maxCoeff(), 1e-11);
  }
}

TEST(SmoothProjection, WithoutLengthItReproducesQuadraticFields) {
  const Projection project;
  const auto g = [](const Vec3& X) { return Vector::Constant(1, X.x() * X.x() - X.y() * X.z() + 1); };
  const Matrix f = project(g, 0);
  for (int n = 0; n < project.basis.num_functions(); ++n)
    EXPECT_NEAR(f(0, n), g(project.basis.nodes().col(n))[0], 1e-11);
}

TEST(SmoothProjection, ALinearFieldBendsAtTheBoundaryAsHelmholtzSays) {
  constexpr double kLength = 0.2;
  const Projection project;
  const Matrix f = project([](const Vec3& X) { return Vector::Constant(1, X.x()); }, kLength);
  for (int n = 0; n < project.basis.num_functions(); ++n) {
    const double x = project.basis.nodes()(0, n);
    // f − ℓ² f'' = x, f'(0) = f'(1) = 0
    const double exact = x - kLength * std::sinh((x - 0.5) / kLength) / std::cosh(0.5 / kLength);
    EXPECT_NEAR(f(0, n), exact, 2e-3);  // layers of width ℓ, a little more than an element
  }
}

TEST(SmoothProjection, WeakensAWaveAsHelmholtzSays) {
  constexpr double kLength = 0.3;
  const Projection project;
  const Matrix f =
      project([](const Vec3& X) { return Vector::Constant(1, std::cos(2 * kPi * X.z())); }, kLength);
  const double factor = 1 / (1 + std::pow(2 * kPi * kLength, 2));  // 0.22
  for (int n = 0; n < project.basis.num_functions(); ++n)
    EXPECT_NEAR(f(0, n), factor * std::cos(2 * kPi * project.basis.nodes()(2, n)), 4e-3);  // elements of λ/6
}

}  // namespace
}  // namespace polyaffine
