#include <gtest/gtest.h>

#include <cmath>
#include <polyaffine/solve/ode.hpp>
#include <stdexcept>

namespace polyaffine {
namespace {

// ẏ = −1000 (y − cos t) − sin t, y(0) = 2: a fast transient e^{−1000 t} on top of cos t.
void stiff_linear(double t, const Vector& y, Vector& rate) {
  rate[0] = -1000 * (y[0] - std::cos(t)) - std::sin(t);
}
double stiff_linear_exact(double t) {
  return std::exp(-1000 * t) + std::cos(t);
}

double largest_error(double tolerance) {
  const Vector times = Vector::LinSpaced(200, 0.0, 3.0);
  const OdeOptions options{.relative_tolerance = tolerance, .absolute_tolerance = tolerance};
  const OdeSolution solution = solve_ode(stiff_linear, 0, Vector::Constant(1, 2.0), times, options);
  EXPECT_TRUE(solution.finished()) << solution.message;
  const Vector exact = times.unaryExpr(&stiff_linear_exact);
  return (solution.states.row(0).transpose() - exact).cwiseAbs().maxCoeff();
}

TEST(Ode, ErrorFollowsTheToleranceOnAStiffLinearProblem) {
  for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
    const double error = largest_error(tolerance);
    EXPECT_LT(error, 50 * tolerance);    // local errors of some tens of steps may add up
    EXPECT_GT(error, 1e-3 * tolerance);  // the tolerance is used, not a fixed tighter one
  }
}

TEST(Ode, TakesFarFewerStepsThanAnExplicitMethodNeedsOnAStiffProblem) {
  const OdeSolution solution = solve_ode(stiff_linear, 0, Vector::Constant(1, 2.0), Vector::Constant(1, 3.0),
                                         {.relative_tolerance = 1e-6, .absolute_tolerance = 1e-6});
  EXPECT_LT(solution.steps, 300);  // explicit stability: 3 / (2/1000) = 1500 steps
  EXPECT_GT(solution.jacobian_evaluations, 0);
  EXPECT_GT(solution.rate_evaluations, solution.steps);
}

TEST(Ode, SolvesRobertsonKinetics) {
  const auto robertson = [](double, const Vector& y, Vector& rate) {
    const double slow = 0.04 * y[0], fast = 1e4 * y[1] * y[2], square = 3e7 * y[1] * y[1];
    rate << fast - slow, slow - fast - square, square;
  };
  const Vector times = (Vector(3) << 0.4, 40, 4e3).finished();
  const OdeSolution solution = solve_ode(robertson, 0, Vector::Unit(3, 0), times,
                                         {.relative_tolerance = 1e-9, .absolute_tolerance = 1e-13});
  ASSERT_TRUE(solution.finished());
  // Published solution, four digits (Hindmarsh and Byrne; printed by CVODE's own example).
  EXPECT_NEAR(solution.states(0, 0), 0.98517, 1e-5);
  EXPECT_NEAR(solution.states(0, 1), 0.71583, 1e-5);
  EXPECT_NEAR(solution.states(0, 2), 0.18320, 1e-5);
  EXPECT_NEAR(solution.states(1, 1) * 1e6, 9.1855, 1e-3);
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(solution.states.col(i).sum(), 1, 1e-10);  // linear invariant: kept by BDF
}

TEST(Ode, ReturnsTheInitialStateAtTheStartTime) {
  const Vector times = (Vector(2) << 0.5, 0.75).finished();
  const OdeSolution solution = solve_ode(stiff_linear, 0.5, Vector::Constant(1, 7.0), times);
  EXPECT_EQ(solution.states(0, 0), 7.0);
  EXPECT_DOUBLE_EQ(solution.time_reached, 0.75);
}

TEST(Ode, StepLimitSeesAShortPulse) {
  // Unit pulse of width 0.1 at t = 50 after a long rest: without a step limit the solver jumps over it.
  const auto pulse = [](double t, const Vector&, Vector& rate) {
    const double s = (t - 50) / 0.1;
    rate[0] = std::exp(-s * s);
  };
  const OdeSolution solution =
      solve_ode(pulse, 0, Vector::Zero(1), Vector::Constant(1, 100.0), {.max_step = 0.05});
  EXPECT_NEAR(solution.states(0, 0), 0.1 * std::sqrt(kPi), 1e-6);
  EXPECT_GE(solution.steps, 2000);
}

TEST(Ode, TellsWhyItStoppedEarly) {
  const Vector times = (Vector(2) << 0.01, 3.0).finished();
  const OdeSolution few_steps =
      solve_ode(stiff_linear, 0, Vector::Constant(1, 2.0), times, {.max_steps = 200});
  EXPECT_EQ(few_steps.stop, OdeStop::too_many_steps);
  EXPECT_FALSE(few_steps.message.empty());
  EXPECT_LT(few_steps.time_reached, 3);
  EXPECT_EQ(few_steps.states.cols(), 1);
  EXPECT_EQ(few_steps.steps, 200);

  // ẏ = y², y(0) = 1 has its pole at t = 1.
  const auto blow_up = [](double, const Vector& y, Vector& rate) { rate[0] = y[0] * y[0]; };
  const OdeSolution pole = solve_ode(blow_up, 0, Vector::Ones(1), Vector::Constant(1, 2.0));
  EXPECT_FALSE(pole.finished());
  EXPECT_NEAR(pole.time_reached, 1, 1e-6);
}

TEST(Ode, PassesExceptionsOfTheRightHandSideOn) {
  const auto throws = [](double, const Vector&, Vector&) { throw std::domain_error("outside"); };
  EXPECT_THROW(solve_ode(throws, 0, Vector::Ones(1), Vector::Ones(1)), std::domain_error);
}

TEST(Ode, RejectsArgumentsThatMakeNoSense) {
  const Vector one = Vector::Ones(1);
  EXPECT_THROW(solve_ode(stiff_linear, 2, one, one), std::invalid_argument);
  EXPECT_THROW(solve_ode(stiff_linear, 0, Vector(), one), std::invalid_argument);
  EXPECT_THROW(solve_ode(stiff_linear, 0, one, Vector::Ones(2)), std::invalid_argument);
  EXPECT_THROW(solve_ode(stiff_linear, 0, one, one, {.relative_tolerance = 0}), std::invalid_argument);
  EXPECT_THROW(solve_ode(stiff_linear, 0, one, one, {.max_step = -1}), std::invalid_argument);
}

}  // namespace
}  // namespace polyaffine
