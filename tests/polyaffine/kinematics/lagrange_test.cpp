#include <gtest/gtest.h>

#include <cmath>

#include <polyaffine/core/error.hpp>
#include <polyaffine/kinematics/lagrange.hpp>
#include <polyaffine/material/signed_volume.hpp>
#include <polyaffine/system/field_energy.hpp>
#include "polyaffine/geometry/box_mesh.hpp"
#include "rotating_basis.hpp"

namespace polyaffine {
namespace {

// A sixth of the shell between the spheres of radius ½ and 1: X = r (a, b, 1)/|(a, b, 1)|, |a|, |b| ≤ 1. Its
// sides are planes through the centre.
TetMesh shell_patch(int n) {
  const TetMesh box = box_mesh(Vec3(-1, -1, 0.5), Vec3(1, 1, 1), {2 * n, 2 * n, n});
  Points X = box.points();
  for (Eigen::Index i = 0; i < X.cols(); ++i) X.col(i) = X(2, i) * Vec3(X(0, i), X(1, i), 1).normalized();
  return {X, box.tets()};
}

// Midpoints on the sphere for all edges whose ends have the same radius.
EdgeMidpoints on_spheres(const TetMesh& mesh) {
  EdgeMidpoints out;
  for (int t = 0; t < mesh.num_tets(); ++t)
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < i; ++j) {
        const auto [a, b] = std::minmax(mesh.tets()(i, t), mesh.tets()(j, t));
        const Vec3 A = mesh.points().col(a), B = mesh.points().col(b);
        if (std::abs(A.norm() - B.norm()) < 1e-9) out[{a, b}] = A.norm() * (A + B).normalized();
      }
  return out;
}

double volume(const LagrangeBasis& basis) {
  return basis.wall_points(4).weights.sum();
}

TEST(Lagrange, FunctionsAreOneAtTheirNodeAndSumToOne) {
  const TetMesh mesh = shell_patch(1);
  for (const int order : {1, 2}) {
    const LagrangeBasis basis(mesh, order, order == 2 ? on_spheres(mesh) : EdgeMidpoints());
    for (int t = 0; t < mesh.num_tets(); t += 5)
      for (unsigned k = 0; k < 4; ++k) {
        Vec4 at = testing::random_vector(4, 1, 10 * k + 1).cwiseAbs();
        at /= at.sum();
        const BasisSample s = basis.sample(t, at);
        EXPECT_NEAR(s.N.sum(), 1, 1e-14);
        EXPECT_LT(s.gradient.rowwise().sum().norm(), 1e-12);
        const Vec4 vertex = Vec4::Unit(k);
        EXPECT_EQ(basis.sample(t, vertex).N, Vector::Unit(order == 1 ? 4 : 10, k));
      }
  }
  EXPECT_THROW(LagrangeBasis(mesh, 3), InputError);
}

TEST(Lagrange, ReproducesPolynomialsOfItsOrder) {
  const TetMesh mesh = box_mesh(Vec3::Zero(), Vec3::Ones(), {2, 2, 2}, 0.2);
  const auto affine = [](const Vec3& x) { return 1 + 2 * x[0] - x[1] + 0.5 * x[2]; };
  const auto quadratic = [&](const Vec3& x) {
    return affine(x) + x[0] * x[1] - 3 * x[1] * x[2] + x[2] * x[2] - 2 * x[0] * x[0];
  };
  const auto slope = [](const Vec3& x) {
    return Vec3(2 + x[1] - 4 * x[0], -1 + x[0] - 3 * x[2], 0.5 - 3 * x[1] + 2 * x[2]);
  };
  for (const int order : {1, 2}) {
    const LagrangeBasis basis(mesh, order);
    Vector a(basis.num_functions()), q(basis.num_functions());
    for (int i = 0; i < basis.num_functions(); ++i) {
      a[i] = affine(basis.nodes().col(i));
      q[i] = quadratic(basis.nodes().col(i));
    }
    double largest = 0;
    const Vec4 at(0.1, 0.25, 0.3, 0.35);
    for (int t = 0; t < mesh.num_tets(); ++t) {
      const Vec3 x = mesh.points()(Eigen::all, mesh.tets().col(t)) * at;
      const BasisSample s = basis.sample(t, at);
      EXPECT_NEAR(basis.interpolate(a, t, at), affine(x), 1e-13);
      EXPECT_LT((s.gradient * a(s.functions) - Vec3(2, -1, 0.5)).norm(), 1e-12);
      const double error = (s.gradient * q(s.functions) - slope(x)).norm();
      largest = std::max({largest, error, std::abs(basis.interpolate(q, t, at) - quadratic(x))});
    }
    if (order == 2)
      EXPECT_LT(largest, 1e-12);
    else
      EXPECT_GT(largest, 0.1);  // linear elements do not hold a quadratic field
  }
}

TEST(Lagrange, CurvedVolumeConvergesWithOrderFour) {
  const double exact = 2 * kPi / 3 * (1 - 0.125) / 3;
  std::vector<double> straight, curved;
  for (const int n : {2, 4, 8}) {
    const TetMesh mesh = shell_patch(n);
    straight.push_back(std::abs(volume(LagrangeBasis(mesh, 1)) - exact));
    curved.push_back(std::abs(volume(LagrangeBasis(mesh, 2, on_spheres(mesh))) - exact));
  }
  // Orders 2 and 4; the coarse meshes are a little off the asymptotic rate.
  EXPECT_NEAR(std::log2(straight[1] / straight[2]), 2, 0.1);
  EXPECT_NEAR(std::log2(curved[1] / curved[2]), 4, 0.4);
  EXPECT_LT(curved[2], straight[2] / 100);
}

TEST(Lagrange, CurvedSurfaceEnclosesTheCurvedVolume) {
  const TetMesh mesh = shell_patch(2);
  const LagrangeBasis basis(mesh, 2, on_spheres(mesh));
  // Degree 4 integrates x · (x_ξ × x_η) of quadratic faces exactly.
  const FieldEnergy enclosed(
      surface_table(basis, basis.surface_points(mesh, {TetMesh::kUnlabelled}, 4), Vec3(0.1, 0.2, 0.3)),
      {std::make_shared<SignedVolume>(1.0 / 3)});
  const Vector none = Vector::Zero(3 * basis.num_functions());
  EXPECT_NEAR(enclosed.evaluate({none}).value, volume(basis), 1e-12);
  // A stretch along the axes makes ellipsoids of the spheres.
  const Points u = Vec3(1, 0, 2).asDiagonal() * basis.nodes();
  EXPECT_NEAR(enclosed.evaluate({u.reshaped()}).value, 6 * volume(basis), 1e-11);
}

TEST(Lagrange, SmoothMidpointsRoundABall) {
  // A cube pressed radially into a ball: its faces become a sphere without edges.
  const auto ball = [](int n) {
    const TetMesh box = box_mesh(Vec3(-1, -1, -1), Vec3(1, 1, 1), {n, n, n});
    Points X = box.points();
    for (Eigen::Index i = 0; i < X.cols(); ++i)
      if (const double r = X.col(i).norm(); r > 0) X.col(i) *= X.col(i).cwiseAbs().maxCoeff() / r;
    LabelledTriangles surface{box.boundary(), std::vector<int>(box.boundary().cols(), 1)};
    return TetMesh(X, box.tets(), {}, surface);
  };
  const TetMesh mesh = ball(8);
  const double exact = 4 * kPi / 3;
  const double straight = std::abs(volume(LagrangeBasis(mesh, 1)) / exact - 1);
  const double curved = std::abs(volume(LagrangeBasis(mesh, 2, smooth_midpoints(mesh))) / exact - 1);
  EXPECT_LT(curved, straight / 5);
}

TEST(Lagrange, SurfaceNodesLieOnTheSurface) {
  const auto cube = testing::unit_cube();
  const TetMesh mesh(cube.points, cube.tets, {}, testing::cube_labels());
  const LagrangeBasis basis(mesh, 2);
  const std::vector<int> nodes = basis.surface_nodes(mesh, {2});
  EXPECT_EQ(nodes.size(), 9U);  // four corners, five edges of two triangles
  for (const int n : nodes) EXPECT_EQ(basis.nodes()(2, n), 1);
}

}  // namespace
}  // namespace polyaffine
