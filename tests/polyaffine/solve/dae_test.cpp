#include "polyaffine/solve/dae.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace polyaffine {
namespace {

// A term by functions: R(t, y, ẏ), and its derivatives by y and by ẏ.
struct Equations : Term {
  std::function<bool(double, const Vector&, const Vector&, Vector&)> R;  // false: not admissible
  std::function<Matrix(double, const Vector&)> by_y;
  Matrix by_rate;

  void add_residual(const At& at, Residual& out) const override {
    out.min_det = R(at.t, at.y, *at.rate, out.values) ? 1 : -1;
  }
  void add_tangent(const At& at, double alpha, Tangent& out) const override {
    out.corner += by_y(at.t, at.y) + alpha * by_rate;
  }
};

// A system of such a term, with a tolerance for each of its few unknowns.
struct SmallSystem {
  Equations equations;
  Vector tolerance = Vector();
  std::vector<char> untested = {};

  System system() const {
    System out;
    for (Eigen::Index i = 0; i < equations.by_rate.rows(); ++i)
      out.layout.add({.name = "y" + std::to_string(i),
                      .unit = "1",
                      .absolute_tolerance = tolerance[i],
                      .error_tested = untested.empty() || !untested[static_cast<std::size_t>(i)]},
                     1);
    out.terms.push_back(std::make_shared<Equations>(equations));
    return out;
  }
};

// ẏ = z + cos t − sin² t, 0 = z − y²: of index 1, with y = sin t, z = sin² t.
SmallSystem index_one(const Vector& tolerance) {
  SmallSystem small{{}, tolerance};
  Equations& s = small.equations;
  s.by_rate = Vector(Eigen::Vector2d(1, 0)).asDiagonal();
  s.R = [](double t, const Vector& y, const Vector& rate, Vector& out) {
    out.resize(2);
    out << rate[0] - y[1] - std::cos(t) + std::pow(std::sin(t), 2), y[1] - y[0] * y[0];
    return true;
  };
  s.by_y = [](double, const Vector& y) { return (Matrix(2, 2) << 0, -1, -2 * y[0], 1).finished(); };
  return small;
}

DaeOptions options(double tolerance) {
  return {.relative_tolerance = tolerance};
}

const Vector kStart = Eigen::Vector2d(0, 0);
const Vector kStartRate = Eigen::Vector2d(1, 0);

void run_to(DaeIntegrator& integrator, double end) {
  while (integrator.time() < end) ASSERT_EQ(integrator.step(end), DaeStatus::reached);
}

TEST(Dae, ErrorFollowsTheTolerance) {
  double before = 1;
  for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
    const System system = index_one(Vector::Constant(2, tolerance)).system();
    DaeIntegrator integrator(system, options(tolerance), 0, kStart, kStartRate);
    run_to(integrator, 1.5);
    EXPECT_EQ(integrator.time(), 1.5);  // not past the limit
    const double s = std::sin(1.5);
    const double error = (integrator.y() - Eigen::Vector2d(s, s * s)).norm();
    // The tolerance holds for one step; perturbations of y grow by exp(∫2 sin t), about 6, on the way.
    EXPECT_LT(error, 300 * tolerance);
    EXPECT_LT(error, before / 5);
    before = error;
  }
}

TEST(Dae, InterpolatesInsideTheLastStepAndKeepsTheLargestStep) {
  const System system = index_one(Vector::Constant(2, 1e-8)).system();
  DaeOptions o = options(1e-8);
  o.max_step = 0.01;
  DaeIntegrator integrator(system, o, 0, kStart, kStartRate);
  double before = 0;
  while (integrator.time() < 1) {
    ASSERT_EQ(integrator.step(1), DaeStatus::reached);
    EXPECT_LE(integrator.time() - before, 0.01 * (1 + 1e-9));
    const double middle = (before + integrator.time()) / 2;
    Vector y;
    integrator.interpolate(middle, y);
    EXPECT_NEAR(y[0], std::sin(middle), 1e-6);
    before = integrator.time();
  }
  EXPECT_NEAR(integrator.rate()[0], std::cos(1), 1e-5);
}

// Whatever the error allows, or the largest step: else rounding would move every step.
TEST(Dae, StepsChangeByFixedFactors) {
  std::vector<double> factors = {2};  // at the start, while the order rises
  for (double cut = 1; cut > 1e-3; cut /= 2) factors.insert(factors.end(), {cut, 1.5 * cut});
  for (const double largest : {0.0, 0.01}) {
    const System system = index_one(Vector::Constant(2, 1e-6)).system();
    DaeOptions o = options(1e-6);
    o.max_step = largest;
    DaeIntegrator integrator(system, o, 0, kStart, kStartRate);
    double before = 0, last = 0;
    int changes = 0;
    while (integrator.time() < 1.5) {
      ASSERT_EQ(integrator.step(3), DaeStatus::reached);
      const double h = integrator.time() - before;
      if (last > 0) {
        const auto near = [&](double f) { return std::abs(h / last - f) < 1e-9; };
        EXPECT_TRUE(std::ranges::any_of(factors, near)) << h / last;
        if (!near(1)) ++changes;
      }
      before = integrator.time();
      last = h;
    }
    EXPECT_GE(changes, 3);
    EXPECT_GT(last, largest / 1.5 * (1 - 1e-9));
  }
}

TEST(Dae, TheErrorTestLeavesOutWhatItIsTold) {
  const auto steps = [](const std::vector<char>& untested) {
    SmallSystem small = index_one(Eigen::Vector2d(1e-4, 1e-6));
    small.untested = untested;
    const System system = small.system();
    DaeIntegrator integrator(system, options(0), 0, kStart, kStartRate);
    run_to(integrator, 1.5);
    EXPECT_NEAR(integrator.y()[0], std::sin(1.5), 300 * 1e-4);  // as in ErrorFollowsTheTolerance
    EXPECT_NEAR(integrator.y()[1], std::pow(integrator.y()[0], 2), 1e-5);
    return static_cast<double>(integrator.counters().steps);
  };
  EXPECT_LT(1.4 * steps({0, 1}), steps({}));
}

TEST(Dae, CountsItsWork) {
  SmallSystem small = index_one(Vector::Constant(2, 1e-6));
  long calls = 0;
  const auto R = small.equations.R;
  small.equations.R = [&calls, R](double t, const Vector& y, const Vector& rate, Vector& out) {
    ++calls;
    return R(t, y, rate, out);
  };
  const System system = small.system();
  DaeIntegrator integrator(system, options(1e-6), 0, kStart, kStartRate);
  EXPECT_EQ(integrator.counters().steps, 0);
  long steps = 0;
  for (; integrator.time() < 1; ++steps) ASSERT_EQ(integrator.step(1), DaeStatus::reached);
  const DaeCounters c = integrator.counters();
  EXPECT_EQ(c.steps, steps);
  EXPECT_EQ(c.residuals, calls);
  EXPECT_GT(c.newton_iterations, 0);
  EXPECT_GT(c.factorisations, 0);
  EXPECT_LT(c.factorisations, c.newton_iterations);     // a factorisation serves several iterations
  EXPECT_LT(c.convergence_failures, c.factorisations);  // each asks for a new one
}

// Robertson's reactions with y₁ + y₂ + y₃ = 1 (Hairer & Wanner 1996, the values at t = 40).
TEST(Dae, StiffReactions) {
  SmallSystem small{{}, Vec3(1e-9, 1e-12, 1e-9)};
  small.equations.by_rate = Vec3(1, 1, 0).asDiagonal();
  small.equations.R = [](double, const Vector& y, const Vector& rate, Vector& out) {
    const double forth = -0.04 * y[0] + 1e4 * y[1] * y[2];
    out.resize(3);
    out << rate[0] - forth, rate[1] + forth + 3e7 * y[1] * y[1], y.sum() - 1;
    return true;
  };
  small.equations.by_y = [](double, const Vector& y) {
    Matrix J(3, 3);
    J << 0.04, -1e4 * y[2], -1e4 * y[1], -0.04, 1e4 * y[2] + 6e7 * y[1], 1e4 * y[1], 1, 1, 1;
    return J;
  };
  const System system = small.system();
  DaeIntegrator integrator(system, options(1e-7), 0, Vec3(1, 0, 0), Vec3(-0.04, 0.04, 0));
  run_to(integrator, 40);
  EXPECT_NEAR(integrator.y()[0], 0.7158270688, 1e-5);
  EXPECT_NEAR(integrator.y()[1], 9.185534765e-6, 1e-9);
  EXPECT_NEAR(integrator.y()[2], 0.2841637457, 1e-5);
  EXPECT_LT(integrator.counters().steps, 1000);  // an explicit method would need some 10⁵
}

TEST(Dae, AnInadmissibleStateFailsInWordsAndKeepsTheLastGoodOne) {
  SmallSystem small = index_one(Vector::Constant(2, 1e-6));
  const auto R = small.equations.R;
  small.equations.R = [R](double t, const Vector& y, const Vector& rate, Vector& out) {
    return y[0] < 0.5 && R(t, y, rate, out);  // sin t = ½ at t = π/6
  };
  const System system = small.system();
  DaeIntegrator integrator(system, options(1e-6), 0, kStart, kStartRate);
  DaeStatus status = DaeStatus::reached;
  while (status == DaeStatus::reached && integrator.time() < 1) status = integrator.step(1);
  ASSERT_EQ(status, DaeStatus::failed);
  EXPECT_THAT(integrator.failure(), ::testing::HasSubstr("smallest step"));
  EXPECT_GT(integrator.time(), 0.4);
  EXPECT_LE(integrator.time(), 0.5237);
  EXPECT_NEAR(integrator.y()[0], std::sin(integrator.time()), 1e-4);
  EXPECT_LT(integrator.y()[0], 0.5);
}

TEST(Dae, ASingularTangentFailsInWords) {
  SmallSystem small = index_one(Vector::Constant(2, 1e-6));
  small.equations.by_y = [](double, const Vector&) {
    return Matrix(Matrix::Zero(2, 2));
  };  // second row stays zero
  const System system = small.system();
  DaeIntegrator integrator(system, options(1e-6), 0, kStart, kStartRate);
  ASSERT_EQ(integrator.step(1), DaeStatus::failed);
  EXPECT_FALSE(integrator.failure().empty());
  EXPECT_THAT(integrator.failure(), ::testing::Not(::testing::HasSubstr("IDA code")));
  EXPECT_EQ(integrator.time(), 0);
}

}  // namespace
}  // namespace polyaffine
