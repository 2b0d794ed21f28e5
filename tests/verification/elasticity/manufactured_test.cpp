#include <gtest/gtest.h>

#include <polyaffine/kinematics/lagrange.hpp>
#include <polyaffine/material/linear_elastic.hpp>
#include <polyaffine/solve/newton.hpp>
#include <polyaffine/system/field_term.hpp>
#include <polyaffine/system/sparse_field.hpp>

#include "support/convergence.hpp"
#include "support/labelled_box.hpp"

namespace polyaffine {
namespace {

const Elasticity kElasticity{10, 0.3};  // kPa

// Dead force per volume: W = −b·u over a table with M = [u, 0, 0].
class BodyForce : public Law {
 public:
  explicit BodyForce(Points b) : b_(std::move(b)) {}
  void respond(PackPoints points, const PackMotion& at, bool, PackResponse& r) const override {
    const Mat3Pack& M = at.F;
    for (int i = 0; i < 3; ++i) {
      const Pack b = gather(b_.data() + 3 * static_cast<std::ptrdiff_t>(points.point) + i, 3, points.lanes);
      r.W -= b * M.m[i];
      r.P[i] = -b;
    }
  }

 private:
  Points b_;
};

// u = a sin(k·X + 1), for which −div σ = (μ |k|² a + (λ + μ)(k·a) k) sin(k·X + 1).
const Vec3 kAmplitude(0.02, -0.03, 0.01);
const Vec3 kWave(2.5, 2, -3);
Vec3 exact(const Vec3& X) {
  return kAmplitude * std::sin(kWave.dot(X) + 1);
}
Vec3 body_force(const Vec3& X) {
  const Lame l = lame(kElasticity);
  return (l.mu * kWave.squaredNorm() * kAmplitude + (l.lambda + l.mu) * kWave.dot(kAmplitude) * kWave) *
         std::sin(kWave.dot(X) + 1);
}

double solution_error(int order, int cells) {
  const TetMesh mesh = testing::labelled_cube(cells);
  const LagrangeBasis basis(mesh, order);
  const WallPoints points = basis.wall_points(4);
  SurfacePoints places{points.tet, points.barycentric, points.weights, {}, {}, {}, points.starts};
  Points force(3, points.barycentric.cols());
  for (Eigen::Index q = 0; q < force.cols(); ++q) {
    const BasisSample s = basis.sample(points.tet[q], points.barycentric.col(q));
    force.col(q) = body_force(basis.nodes()(Eigen::all, s.functions) * s.N);
  }
  using Laws = std::vector<std::shared_ptr<const Law>>;
  const auto wall = std::make_shared<FieldEnergy>(deformation_table(basis, points),
                                                  Laws{std::make_shared<LinearElastic>(kElasticity)});
  const auto load = std::make_shared<FieldEnergy>(displacement_table(basis, places),
                                                  Laws{std::make_shared<BodyForce>(force)});
  System problem = field_system(3 * basis.num_functions(), {solid(wall), polyaffine::load(load)});
  problem.linear = sparse_field;
  problem.fixed.assign(3 * basis.num_functions(), 0);
  problem.prescribed = Vector::Zero(3 * basis.num_functions());
  for (const int node : basis.surface_nodes(mesh, {1, 2, 3, 4, 5, 6})) {
    problem.prescribed.segment<3>(3 * node) = exact(basis.nodes().col(node));
    for (int k = 0; k < 3; ++k) problem.fixed[3 * node + k] = 1;
  }
  Vector c = Vector::Zero(3 * basis.num_functions());
  const NewtonReport report = newton(problem, 1, *problem.make_linear(), c);
  EXPECT_TRUE(report.converged());
  EXPECT_EQ(report.iterations, 1);  // the problem is linear
  return testing::l2_error(basis, c.reshaped(3, basis.num_functions()), exact);
}

TEST(Manufactured, LinearElementsConvergeWithTheSecondOrder) {
  const double coarse = solution_error(1, 3);
  const double middle = solution_error(1, 6);
  const double fine = solution_error(1, 12);
  EXPECT_GT(testing::order(coarse, middle), 1.7);  // not yet asymptotic
  EXPECT_NEAR(testing::order(middle, fine), 2, 0.15);
}

TEST(Manufactured, QuadraticElementsConvergeWithTheThirdOrder) {
  const double coarse = solution_error(2, 2);
  const double middle = solution_error(2, 4);
  const double fine = solution_error(2, 8);
  EXPECT_GT(testing::order(coarse, middle), 2.7);
  EXPECT_NEAR(testing::order(middle, fine), 3, 0.15);
}

}  // namespace
}  // namespace polyaffine
