#include "polyaffine/solve/load_stepping.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include <polyaffine/kinematics/lagrange.hpp>
#include <polyaffine/material/neo_hookean.hpp>
#include <polyaffine/material/springs.hpp>
#include <polyaffine/system/field_term.hpp>
#include <polyaffine/system/sparse_field.hpp>

#include "support/labelled_box.hpp"

namespace polyaffine {
namespace {

constexpr double kLambda = 30, kMu = 10;  // kPa
constexpr double kLength = 3;             // mm, of a bar with unit section

// A bar along x: a basis, its wall, and the tools to hold and pull it.
struct Bar {
  explicit Bar(int order) : basis(mesh, order) {
    wall = std::make_shared<FieldEnergy>(
        deformation_table(basis, basis.wall_points(order == 1 ? 1 : 3)),
        std::vector<std::shared_ptr<const Law>>{std::make_shared<NeoHookean>(Lame{kLambda, kMu})});
    problem = field_system(unknowns(), {solid(wall)});
    problem.linear = sparse_field;
    problem.fixed.assign(unknowns(), 0);
    problem.prescribed = Vector::Zero(unknowns());
  }
  int unknowns() const { return 3 * basis.num_functions(); }
  void hold(int face, int component, double displacement = 0) {
    for (const int node : basis.surface_nodes(mesh, {face})) {
      problem.fixed[3 * node + component] = 1;
      problem.prescribed[3 * node + component] = displacement;
    }
  }
  void clamp(int face) {
    for (int k = 0; k < 3; ++k) hold(face, k);
  }
  void pull(int face, const Vec3& traction) {
    problem.terms.push_back(
        load(std::make_shared<FieldEnergy>(
                 displacement_table(basis, basis.surface_points(mesh, {face}, 2)),
                 std::vector<std::shared_ptr<const Law>>{std::make_shared<DeadTraction>(traction)}),
             [](double t) { return t; }));
  }
  std::unique_ptr<LinearSystem> system() const { return problem.make_linear(); }

  TetMesh mesh = testing::labelled_box(Vec3::Zero(), Vec3(kLength, 1, 1), {3, 2, 2}, 0.2);
  LagrangeBasis basis;
  std::shared_ptr<FieldEnergy> wall;
  System problem;
};

// Lateral stretch l with no lateral stress, μ (l − 1/l) + λ ln(s l²)/l = 0, and the nominal stress along the
// bar.
std::pair<double, double> uniaxial(double s) {
  double low = 0.3;
  double high = 2;
  while (high - low > 1e-15) {
    const double l = (low + high) / 2;
    (kMu * (l * l - 1) + kLambda * std::log(s * l * l) > 0 ? high : low) = l;
  }
  return {low, kMu * (s - 1 / s) + kLambda * std::log(s * low * low) / s};
}

void hold_symmetry(Bar& bar) {
  bar.hold(testing::kXLow, 0);
  bar.hold(testing::kYLow, 1);
  bar.hold(testing::kZLow, 2);
}

class Uniaxial : public ::testing::TestWithParam<double> {};

TEST_P(Uniaxial, PrescribedStretchMatchesTheAnalyticSolution) {
  const double s = GetParam();
  const auto [l, stress] = uniaxial(s);
  Bar bar(2);
  hold_symmetry(bar);
  bar.hold(testing::kXHigh, 0, (s - 1) * kLength);
  Vector c = Vector::Zero(bar.unknowns());
  const LoadReport report = load_stepping(bar.problem, *bar.system(), c);
  ASSERT_TRUE(report.converged());
  EXPECT_EQ(report.reached, 1);
  const Points exact = Vec3(s - 1, l - 1, l - 1).asDiagonal() * bar.basis.nodes();
  EXPECT_LT((c - exact.reshaped()).norm(), 1e-6 * exact.norm());  // the solver's tolerance is 1e-8
  const Vector force = bar.wall->evaluate({c}).gradient;
  double end = 0;
  for (const int node : bar.basis.surface_nodes(bar.mesh, {testing::kXHigh})) end += force[3 * node];
  EXPECT_NEAR(end, stress, 1e-6 * std::abs(stress));  // on a section of 1 mm²
}

INSTANTIATE_TEST_SUITE_P(Equilibrium, Uniaxial, ::testing::Values(0.6, 1.1, 1.8));

TEST(Equilibrium, ADeadTractionStretchesTheBarAsTheStressSays) {
  const auto [l, stress] = uniaxial(1.5);
  Bar bar(1);
  hold_symmetry(bar);
  bar.pull(testing::kXHigh, Vec3(stress, 0, 0));
  Vector c = Vector::Zero(bar.unknowns());
  ASSERT_TRUE(load_stepping(bar.problem, *bar.system(), c).converged());
  const Points exact = Vec3(0.5, l - 1, l - 1).asDiagonal() * bar.basis.nodes();
  EXPECT_LT((c - exact.reshaped()).norm(), 1e-6 * exact.norm());
}

TEST(Equilibrium, NewtonConvergesQuadratically) {
  Bar bar(2);
  bar.clamp(testing::kXLow);
  bar.pull(testing::kXHigh, Vec3(0, 0, 0.3));
  Vector c = Vector::Zero(bar.unknowns());
  NewtonOptions options;
  options.tolerance = 1e-12;
  const NewtonReport report = newton(bar.problem, 1, *bar.system(), c, options);
  ASSERT_TRUE(report.converged());
  ASSERT_EQ(static_cast<int>(report.residuals.size()), report.iterations + 1);
  // Of the steps from a residual already small but well above rounding, each at least squares it up to a
  // constant; linear convergence, a tangent that is slightly wrong, would give a ratio of the order of
  // 1/residual.
  int seen = 0;
  for (std::size_t k = 1; k < report.residuals.size(); ++k) {
    const double before = report.residuals[k - 1];
    const double after = report.residuals[k];
    if (before > 1e-2 || before < 1e-7) continue;
    ++seen;
    EXPECT_LT(after, std::max(100 * before * before, 1e-12));
  }
  EXPECT_GE(seen, 1);
  EXPECT_LE(report.iterations, 9);
}

TEST(Equilibrium, AHardLoadIsCutAndReachesTheSameState) {
  const auto bend = [](double first_step, Vector& c) {
    Bar bar(1);
    bar.clamp(testing::kXLow);
    bar.pull(testing::kXHigh, Vec3(0, 0, 3));
    c = Vector::Zero(bar.unknowns());
    LoadOptions options;
    options.first_step = first_step;
    options.newton.max_iterations = 6;
    return load_stepping(bar.problem, *bar.system(), c, options);
  };
  Vector at_once, slowly;
  const LoadReport hard = bend(1, at_once);
  const LoadReport easy = bend(0.02, slowly);
  ASSERT_TRUE(hard.converged());
  ASSERT_TRUE(easy.converged());
  EXPECT_GE(hard.cuts, 1);
  EXPECT_GE(hard.steps, 2);
  EXPECT_EQ(hard.reached, 1);
  EXPECT_GT(at_once.cwiseAbs().maxCoeff(), 0.5);  // a large deflection
  EXPECT_LT((at_once - slowly).norm(), 1e-5 * slowly.norm());
}

TEST(Equilibrium, AnImpossibleLoadStopsAtTheLastEquilibriumWithAReason) {
  Bar bar(1);
  // The whole boundary follows x → (1 − 1.25 λ) x: beyond λ = 0.8 the volume inside would be negative.
  for (int face = 1; face <= 6; ++face) bar.clamp(face);
  for (int node = 0; node < bar.basis.num_functions(); ++node)
    bar.problem.prescribed[3 * node] = -1.25 * bar.basis.nodes()(0, node);
  Vector c = Vector::Zero(bar.unknowns());
  LoadOptions options;
  options.smallest_step = 1e-2;
  const auto system = bar.system();
  const LoadReport report = load_stepping(bar.problem, *system, c, options);
  EXPECT_FALSE(report.converged());
  EXPECT_EQ(report.reason, StopReason::step_too_small);
  EXPECT_FALSE(to_string(report.reason).empty());
  EXPECT_FALSE(report.last.converged());
  EXPECT_GT(report.reached, 0.5);
  EXPECT_LT(report.reached, 0.8);
  EXPECT_GE(report.cuts, 1);
  Vector again = c;
  const NewtonReport check = newton(bar.problem, report.reached, *system, again);
  EXPECT_TRUE(check.converged());
  EXPECT_EQ(check.iterations, 0);  // it is an equilibrium already
}

TEST(Equilibrium, ABarThatMayBuckleIsToldToBeUnstable) {
  const auto compressed = [](double stretch) {
    Bar bar(2);
    bar.clamp(testing::kXLow);
    bar.hold(testing::kXHigh, 0, (stretch - 1) * kLength);  // its end may sway
    Vector c = Vector::Zero(bar.unknowns());
    LoadOptions options;
    options.first_step = 1;
    const LoadReport report = load_stepping(bar.problem, *bar.system(), c, options);
    EXPECT_TRUE(report.converged());
    return report.unstable_from.has_value();
  };
  EXPECT_FALSE(compressed(1.3));
  EXPECT_FALSE(compressed(0.97));
  EXPECT_TRUE(compressed(0.8));  // Euler's strain is π²/(12 · 3²) = 0.09
}

TEST(Equilibrium, AFailedNewtonLeavesItsStartAlone) {
  Bar bar(1);
  bar.clamp(testing::kXLow);
  bar.pull(testing::kXHigh, Vec3(0, 0, 3));
  const Vector start = Vector::Zero(bar.unknowns());
  Vector c = start;
  NewtonOptions options;
  options.max_iterations = 2;
  const NewtonReport report = newton(bar.problem, 1, *bar.system(), c, options);
  EXPECT_EQ(report.reason, StopReason::max_iterations);
  EXPECT_EQ(report.iterations, 2);
  EXPECT_TRUE(c == start);
}

// A residual that is nothing but rounding has no relative size.
TEST(Equilibrium, NoLoadMovesNothing) {
  Bar bar(2);
  bar.clamp(testing::kXLow);
  bar.pull(testing::kXHigh, Vec3::Zero());
  Vector c = Vector::Zero(bar.unknowns());
  const LoadReport report = load_stepping(bar.problem, *bar.system(), c);
  EXPECT_TRUE(report.converged());
  EXPECT_EQ(report.cuts, 0);
  EXPECT_LT(c.cwiseAbs().maxCoeff(), 1e-15 * kLength);
}

TEST(Equilibrium, TheSmallestLoadsMoveInProportion) {
  const auto pulled = [](double traction) {
    Bar bar(2);
    bar.clamp(testing::kXLow);
    bar.pull(testing::kXHigh, Vec3(0, traction, 0));
    Vector c = Vector::Zero(bar.unknowns());
    EXPECT_TRUE(load_stepping(bar.problem, *bar.system(), c).converged());
    return Vector(c / traction);
  };
  const Vector compliance = pulled(1e-6);
  EXPECT_GT(compliance.norm(), 0.1);
  for (const double traction : {1e-9, 1e-11, 1e-13})
    EXPECT_LT((pulled(traction) - compliance).norm(), 1e-2 * compliance.norm()) << traction;
}

TEST(Equilibrium, AFreeBodyHasASingularTangent) {
  Bar bar(1);
  bar.pull(testing::kXHigh, Vec3(0, 0, 1));
  Vector c = Vector::Zero(bar.unknowns());
  const NewtonReport report = newton(bar.problem, 1, *bar.system(), c);
  EXPECT_FALSE(report.converged());
}

}  // namespace
}  // namespace polyaffine
