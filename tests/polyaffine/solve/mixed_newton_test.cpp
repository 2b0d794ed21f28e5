#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <polyaffine/check/derivative_check.hpp>
#include <polyaffine/core/threads.hpp>
#include <polyaffine/kinematics/lagrange.hpp>
#include <polyaffine/material/neo_hookean.hpp>
#include <polyaffine/material/springs.hpp>
#include <polyaffine/solve/load_stepping.hpp>
#include <polyaffine/system/field_term.hpp>
#include <polyaffine/system/sparse_field.hpp>

#include "support/labelled_box.hpp"
#include "support/matrix_system.hpp"
#include "support/random_vector.hpp"

namespace polyaffine {
namespace {

constexpr double kMu = 10;  // kPa
using Laws = std::vector<std::shared_ptr<const Law>>;

// A bar of 3 × 1 × 1 mm, clamped at one end and bent by a traction on the other.
struct Bar {
  TetMesh mesh = testing::labelled_box(Vec3::Zero(), Vec3(3, 1, 1), {3, 2, 2}, 0.2);
  LagrangeBasis basis{mesh, 2};
  FieldTable table = deformation_table(basis, basis.wall_points(3));

  std::shared_ptr<FieldEnergy> wall(double kappa, bool incompressible) const {
    return wall(block_pressure(table, kappa, incompressible));
  }
  std::shared_ptr<FieldEnergy> wall(const PressureSpace& space) const {
    return std::make_shared<FieldEnergy>(table, Laws{std::make_shared<NeoHookean>(Lame{0, kMu})}, space);
  }
  std::shared_ptr<const FieldEnergy> traction() const {
    return std::make_shared<FieldEnergy>(
        displacement_table(basis, basis.surface_points(mesh, {testing::kXHigh}, 2)),
        Laws{std::make_shared<DeadTraction>(Vec3(0, 0, 0.4))});
  }
  System bending(const std::shared_ptr<FieldEnergy>& wall) const {
    System problem =
        field_system(table.num_unknowns(), {solid(wall), load(traction(), [](double t) { return t; })});
    problem.linear = sparse_field;
    problem.fixed.assign(table.num_unknowns(), 0);
    for (const int node : basis.surface_nodes(mesh, {testing::kXLow}))
      for (int k = 0; k < 3; ++k) problem.fixed[3 * node + k] = 1;
    return problem;
  }
  Vector state(unsigned seed) const { return testing::random_vector(table.num_unknowns(), 0.02, seed); }
};

TEST(MixedEnergy, GradientsAreThoseOfItsValue) {
  const Bar bar;
  for (const bool incompressible : {false, true}) {
    const auto wall = bar.wall(50, incompressible);
    const Vector c = bar.state(1);
    const Vector p = testing::random_vector(bar.mesh.num_tets(), 5, 2);
    const auto by_c = [&](const Vector& x) { return wall->evaluate({x, {}, nullptr, &p}); };
    const auto by_p = [&](const Vector& x) { return wall->evaluate({c, {}, nullptr, &x}); };
    EXPECT_TRUE(check_gradient([&](const Vector& x) { return by_c(x).value; },
                               [&](const Vector& x) { return by_c(x).gradient; }, c)
                    .passed);
    EXPECT_TRUE(check_gradient([&](const Vector& x) { return by_p(x).value; },
                               [&](const Vector& x) { return by_p(x).pressure_gradient; }, p)
                    .passed);
    EXPECT_GT(by_p(p).pressure_gradient.norm(), 1e-3);
  }
}

TEST(MixedEnergy, TangentBlocksAreTheDerivativesOfTheResiduals) {
  const Bar bar;
  const auto wall = bar.wall(50, true);
  const Vector c = bar.state(3);
  const Vector p = testing::random_vector(bar.mesh.num_tets(), 5, 4);
  const auto with = [&](const Vector& x, const Vector& pressure) {
    return wall->evaluate({x, {}, nullptr, &pressure});
  };
  const Vector u = bar.state(5);
  const double h = 1e-5;
  const VolumeGradient D = wall->volume_gradient(c);
  // D u and Dᵀ p
  const Vector Du = (with(c + h * u, p).pressure_gradient - with(c - h * u, p).pressure_gradient) / (2 * h);
  ASSERT_GT(Du.norm(), 1e-4);
  EXPECT_LT((D.times(u) - Du).norm(), 1e-7 * Du.norm());
  const Vector none = Vector::Zero(p.size());
  const Vector Dp = with(c, p).gradient - with(c, none).gradient;
  ASSERT_GT(Dp.norm(), 1e-2);
  EXPECT_LT((D.transpose_times(p) - Dp).norm(), 1e-11 * Dp.norm());
  // K(c, p) u, what the tangent has without κ Dᵀ M⁻¹ D
  const Vector Ku = (with(c + h * u, p).gradient - with(c - h * u, p).gradient) / (2 * h);
  const Vector penalty = D.transpose_times(wall->penalty_pressure(D.times(u)));
  const Vector tangent = testing::tangent(*wall, {c, {}, nullptr, &p}) * u;
  EXPECT_LT((tangent - penalty - Ku).norm(), 1e-6 * Ku.norm());
}

// The condensed residual, κ M⁻¹ g in place of the pressures, vanishes where the mixed form has its solution.
TEST(MixedNewton, FindsTheEquilibriumOfTheCondensedForm) {
  const Bar bar;
  for (const bool regions : {false, true}) {  // one pressure an element, and two over the whole bar
    std::vector<int> half;
    for (Eigen::Index q = 0; q < bar.table.num_points(); ++q) half.push_back(static_cast<int>(q) % 2);
    const auto wall =
        bar.wall(regions ? region_pressure(bar.table, half, 2, 100) : block_pressure(bar.table, 100));
    System problem = bar.bending(wall);
    if (regions) problem.linear = {};  // dense
    Vector c = Vector::Zero(bar.table.num_unknowns());
    ASSERT_TRUE(load_stepping(problem, *problem.make_linear(), c).converged());
    EXPECT_GT(c.cwiseAbs().maxCoeff(), 0.3);
    const Vector wall_force = wall->evaluate({c}).gradient;
    Vector r = wall_force + bar.traction()->evaluate({c}).gradient;
    for (Eigen::Index i = 0; i < r.size(); ++i)
      if (problem.fixed[static_cast<std::size_t>(i)]) r[i] = 0;
    EXPECT_LT(r.norm(), 1e-5 * wall_force.norm());
  }
}

TEST(MixedNewton, FormerTangentsLeadToTheSameEquilibriumWithFewerFactorisations) {
  const Bar bar;
  const System problem = bar.bending(bar.wall(1e5, true));  // a chord that mixed up D would diverge
  const auto solve = [&](double contraction, Vector& c) {
    c = Vector::Zero(bar.table.num_unknowns());
    LoadOptions options;
    options.newton.contraction = contraction;
    return load_stepping(problem, *problem.make_linear(), c, options);
  };
  Vector exact, chords, strict;
  const LoadReport each = solve(0, exact), few = solve(0.25, chords), slow = solve(0.01, strict);
  ASSERT_TRUE(each.converged());
  ASSERT_TRUE(few.converged());
  ASSERT_TRUE(slow.converged());
  EXPECT_EQ(each.tangents, each.iterations);
  EXPECT_LT(3 * few.tangents, 2 * each.tangents);
  // Hardly a step lowers the residuals to a hundredth, but many pass within a few.
  EXPECT_LT(3 * slow.tangents, 2 * each.tangents);
  EXPECT_LE(few.iterations, 40);
  for (const Vector& c : {chords, strict})
    EXPECT_LT((c - exact).norm(), 1e-6 * exact.norm());  // both residuals below 1e-8
}

TEST(MixedNewton, AStiffVolumeCostsNoMoreIterationsThanASoftOne) {
  const Bar bar;
  std::vector<int> iterations;
  for (const double kappa : {10.0, 1e3, 1e5, 1e7}) {
    const System problem = bar.bending(bar.wall(kappa, false));
    Vector c = Vector::Zero(bar.table.num_unknowns());
    const LoadReport report = load_stepping(problem, *problem.make_linear(), c);
    ASSERT_TRUE(report.converged()) << kappa;
    iterations.push_back(report.iterations);
  }
  EXPECT_LE(iterations.back(), iterations.front() + 6);
}

TEST(MixedNewton, AnIncompressibleSpaceKeepsEveryMeanDilatationWhateverThePenalty) {
  const Bar bar;
  Vector first;
  for (const double penalty : {1e4, 1e6}) {
    const auto wall = bar.wall(penalty, true);
    const System problem = bar.bending(wall);
    Vector c = Vector::Zero(bar.table.num_unknowns());
    ASSERT_TRUE(load_stepping(problem, *problem.make_linear(), c).converged());
    EXPECT_LT(wall->pressure(c).cwiseAbs().maxCoeff() / penalty, 1e-7);
    if (first.size() == 0) first = c;
    EXPECT_LT((c - first).norm(), 1e-5 * c.norm());
  }
}

TEST(MixedNewton, HasTheSameBitsOnOneThreadAndOnTwo) {
  use_threads();
  const Bar bar;
  std::vector<Vector> results;
  for (const std::size_t threads : {1, 2}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    const System problem = bar.bending(bar.wall(1e3, true));
    Vector c = Vector::Zero(bar.table.num_unknowns());
    ASSERT_TRUE(load_stepping(problem, *problem.make_linear(), c).converged());
    results.push_back(c);
  }
  EXPECT_TRUE(results[0] == results[1]);
}

}  // namespace
}  // namespace polyaffine
