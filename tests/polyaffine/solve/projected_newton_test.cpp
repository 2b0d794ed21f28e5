#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <polyaffine/core/error.hpp>
#include <polyaffine/kinematics/lagrange.hpp>
#include <polyaffine/linear/projection.hpp>
#include <polyaffine/material/neo_hookean.hpp>
#include <polyaffine/material/springs.hpp>
#include <polyaffine/solve/load_stepping.hpp>
#include <polyaffine/system/field_term.hpp>
#include <polyaffine/system/support.hpp>
#include "polyaffine/geometry/box_mesh.hpp"

namespace polyaffine {
namespace {

Matrix random_matrix(Eigen::Index rows, Eigen::Index cols, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  return Matrix::NullaryExpr(rows, cols, [&] { return uniform(random); });
}

TEST(Projection, SpansAllSolutionsOfTheConstraints) {
  const LinearConstraints constraints{random_matrix(5, 12, 1), random_matrix(5, 1, 2)};
  const Projection p = project(constraints);
  EXPECT_EQ(p.rank, 5);
  ASSERT_EQ(p.num_free(), 7);
  // Round-off of a well conditioned decomposition.
  EXPECT_LT((p.Z.transpose() * p.Z - Matrix::Identity(7, 7)).norm(), 1e-13);
  EXPECT_LT((p.Z.transpose() * p.c0).norm(), 1e-13);
  EXPECT_LT(p.residual, 1e-13);
  const Vector y = random_matrix(7, 1, 3);
  EXPECT_LT((constraints.C * p.expand(y) - constraints.d).norm(), 1e-13);
  EXPECT_LT((p.reduce(p.expand(y)) - y).norm(), 1e-13);
}

TEST(Projection, AcceptsRepeatedAndRejectsContradictoryConstraints) {
  const Matrix C = random_matrix(3, 6, 4);
  const Vector d = random_matrix(3, 1, 5);
  LinearConstraints twice{Matrix(5, 6), Vector(5)};
  twice.C << C, C.row(0) - 2 * C.row(2), C.row(1);
  twice.d << d, d[0] - 2 * d[2], d[1];
  const Projection p = project(twice);
  EXPECT_EQ(p.rank, 3);
  EXPECT_EQ(p.num_free(), 3);
  EXPECT_LT((p.c0 - project({C, d}).c0).norm(), 1e-13);
  twice.d[4] += 0.01;
  EXPECT_THROW(project(twice), InputError);
  EXPECT_THROW(project({C, d.head(2)}), InputError);
  EXPECT_THROW(project({C, Vector::Constant(3, NAN)}), InputError);
}

TEST(Projection, CoversNoneAndAllUnknowns) {
  const Projection none = project({Matrix(0, 4), Vector(0)});
  EXPECT_EQ(none.num_free(), 4);
  EXPECT_EQ(none.c0, Vector::Zero(4));
  const Matrix C = random_matrix(4, 4, 6);
  const Vector c = random_matrix(4, 1, 7);
  const Projection all = project({C, C * c});
  EXPECT_EQ(all.num_free(), 0);
  EXPECT_LT((all.expand(Vector(0)) - c).norm(), 1e-12);
}

// A neo-Hookean unit cube that is held at z = 0 and sheared and stretched at z = 1.
struct Cube {
  static TetMesh make_mesh() {
    const TetMesh box = box_mesh(Vec3::Zero(), Vec3::Ones(), {2, 2, 3});
    std::vector<int> labels;
    for (Eigen::Index f = 0; f < box.boundary().cols(); ++f) {
      const auto z = box.points()(2, box.boundary().col(f));
      labels.push_back(z.maxCoeff() == 0 ? 1 : z.minCoeff() == 1 ? 2 : 3);
    }
    return {box.points(), box.tets(), {}, {box.boundary(), labels}};
  }
  TetMesh mesh = make_mesh();
  LagrangeBasis basis{mesh, 1};
  std::shared_ptr<const FieldEnergy> wall = std::make_shared<FieldEnergy>(
      deformation_table(basis, basis.wall_points(1)),
      std::vector<std::shared_ptr<const Law>>{std::make_shared<NeoHookean>(Lame{.lambda = 8, .mu = 3})});
  Vec3 top{0.1, 0.05, 0.2};

  // Held and moved by fixing the unknowns of nodes themselves: the discrete solution to compare with.
  Vector exact() const {
    System problem = field_system(3 * basis.num_functions(), {solid(wall)});
    problem.fixed.assign(3 * basis.num_functions(), 0);
    problem.prescribed = Vector::Zero(3 * basis.num_functions());
    for (const int label : {1, 2})
      for (const int n : basis.surface_nodes(mesh, {label}))
        for (int k = 0; k < 3; ++k) {
          problem.fixed[3 * n + k] = 1;
          problem.prescribed[3 * n + k] = label == 2 ? top[k] : 0;
        }
    return solve(problem);
  }

  Vector solve(const System& problem) const {
    Vector c = Vector::Zero(3 * basis.num_functions());
    LoadOptions options;
    options.newton.tolerance = 1e-11;
    EXPECT_TRUE(load_stepping(problem, *problem.make_linear(), c, options).converged());
    return c;
  }
};

TEST(Projection, PrescribesTheDisplacementOfAFace) {
  const Cube cube;
  // At the points of a rule, more than there are nodes: the constraints repeat each other.
  std::vector<int> tet;
  std::vector<Vec4> at;
  std::vector<Vec3> u;
  for (const int label : {1, 2}) {
    const SurfacePoints points = cube.basis.surface_points(cube.mesh, {label}, 3);
    for (std::size_t q = 0; q < points.tet.size(); ++q) {
      tet.push_back(points.tet[q]);
      at.emplace_back(points.barycentric.col(static_cast<Eigen::Index>(q)));
      u.push_back(label == 2 ? cube.top : Vec3::Zero());
    }
  }
  const auto n = static_cast<Eigen::Index>(tet.size());
  Eigen::Matrix4Xd barycentric(4, n);
  Points prescribed(3, n);
  for (Eigen::Index q = 0; q < n; ++q) {
    barycentric.col(q) = at[q];
    prescribed.col(q) = u[q];
  }
  System problem = field_system(3 * cube.basis.num_functions(), {solid(cube.wall)});
  problem.projection = std::make_shared<Projection>(
      project(displacement_constraints(cube.basis, tet, barycentric, prescribed)));
  EXPECT_EQ(problem.projection->rank, 2 * 3 * 9);  // the nodes of two faces
  EXPECT_GT(3 * n, problem.projection->rank);

  const Vector exact = cube.exact();
  const Vector c = cube.solve(problem);
  EXPECT_GT(exact.norm(), 0.5);
  // Newton's tolerance on the forces times the condition of the stiffness.
  EXPECT_LT((c - exact).norm(), 1e-9 * exact.norm());
  const Points reached = DisplacementMap(cube.basis, tet, barycentric).apply(c);
  EXPECT_LT((reached - prescribed).cwiseAbs().maxCoeff(), 1e-13);
}

// ½ k |u − u₀|² = ½ k |u|² − k u₀·u + const: a spring and a dead traction.
TEST(Support, ConvergesToThePrescribedDisplacementAsOneOverK) {
  const Cube cube;
  const Vector exact = cube.exact();
  std::vector<double> error;
  for (const double k : {1e4, 1e5, 1e6}) {
    System problem = field_system(3 * cube.basis.num_functions(), {solid(cube.wall)});
    for (const int label : {1, 2}) {
      const FieldTable table =
          displacement_table(cube.basis, cube.basis.surface_points(cube.mesh, {label}, 2));
      problem.terms.push_back(std::make_shared<Support>(table, SupportParameters{.stiffness_kPa_per_mm = k}));
      if (label == 1) continue;
      problem.terms.push_back(load(
          std::make_shared<FieldEnergy>(
              table, std::vector<std::shared_ptr<const Law>>{std::make_shared<DeadTraction>(k * cube.top)}),
          [](double t) { return t; }));
    }
    error.push_back((cube.solve(problem) - exact).norm());
  }
  // First order in 1/k; the second order term takes .05 and .005 from the ratios at these stiffnesses.
  EXPECT_NEAR(error[0] / error[1], 10, 0.1);
  EXPECT_NEAR(error[1] / error[2], 10, 0.01);
  EXPECT_GT(error[2], 1e-8);
}

}  // namespace
}  // namespace polyaffine
