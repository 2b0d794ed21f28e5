#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <polyaffine/check/derivative_check.hpp>
#include <polyaffine/core/error.hpp>

namespace polyaffine {
namespace {

// f = x0² x1 + sin x2 with its exact gradient and Hessian.
double value(const Vector& x) {
  return x[0] * x[0] * x[1] + std::sin(x[2]);
}
Vector gradient(const Vector& x) {
  return Eigen::Vector3d(2 * x[0] * x[1], x[0] * x[0], std::cos(x[2]));
}
Matrix hessian(const Vector& x) {
  Matrix h = Matrix::Zero(3, 3);
  h(0, 0) = 2 * x[1];
  h(0, 1) = h(1, 0) = 2 * x[0];
  h(2, 2) = -std::sin(x[2]);
  return h;
}
const Vector kPoint = Eigen::Vector3d(0.7, -1.3, 0.4);

TEST(DerivativeCheck, AcceptsAnExactGradientAndHessian) {
  const DerivativeReport first = check_gradient(value, gradient, kPoint);
  EXPECT_TRUE(first.passed);
  EXPECT_FALSE(first.is_zero);
  // Central differences reach about the 2/3 power of the rounding error, 4e-11, at a step about its cube
  // root.
  EXPECT_LT(first.relative_error, 1e-9);
  EXPECT_GT(first.best_step, 1e-7);
  EXPECT_LT(first.best_step, 1e-3);
  EXPECT_DOUBLE_EQ(first.magnitude, 1.82);
  EXPECT_TRUE(check_jacobian(gradient, hessian, kPoint).passed);
}

TEST(DerivativeCheck, RejectsAWrongFactor) {
  const auto wrong = [](const Vector& x) { return (1.001 * gradient(x)).eval(); };
  const DerivativeReport report = check_gradient(value, wrong, kPoint);
  EXPECT_FALSE(report.passed);
  EXPECT_NEAR(report.relative_error, 1e-3, 1e-5);  // the factor is what the report shows
}

TEST(DerivativeCheck, RejectsAWrongSign) {
  const DerivativeReport report = check_gradient(
      value, [](const Vector& x) { return (-gradient(x)).eval(); }, kPoint);
  EXPECT_FALSE(report.passed);
  EXPECT_NEAR(report.relative_error, 2, 1e-6);
}

TEST(DerivativeCheck, RejectsAndNamesOneWrongEntry) {
  const auto wrong = [](const Vector& x) {
    Matrix h = hessian(x);
    h(2, 1) += 1e-3;
    return h;
  };
  const DerivativeReport report = check_jacobian(gradient, wrong, kPoint);
  EXPECT_FALSE(report.passed);
  EXPECT_EQ(report.worst_row, 2);
  EXPECT_EQ(report.worst_column, 1);
}

TEST(DerivativeCheck, RejectsATransposedJacobian) {
  const Matrix B = (Matrix(2, 2) << 1, 2, 3, 4).finished();
  const auto linear = [&](const Vector& x) { return (B * x).eval(); };
  const Vector x = Eigen::Vector2d(0.3, 0.2);
  EXPECT_TRUE(check_jacobian(
                  linear, [&](const Vector&) { return B; }, x)
                  .passed);
  EXPECT_FALSE(check_jacobian(
                   linear, [&](const Vector&) { return Matrix(B.transpose()); }, x)
                   .passed);
}

TEST(DerivativeCheck, RejectsAZeroDerivativeEvenWhenItIsRight) {
  const DerivativeReport report = check_gradient(
      [](const Vector&) { return 5.0; }, [](const Vector&) { return Vector::Zero(3).eval(); }, kPoint);
  EXPECT_TRUE(report.is_zero);
  EXPECT_FALSE(report.passed);
}

TEST(DerivativeCheck, RejectsADerivativeThatIsOnlyRoundOff) {
  const auto noise = [](const Vector&) { return Vector::Constant(3, 1e-15).eval(); };
  const DerivativeReport report = check_gradient([](const Vector&) { return 5.0; }, noise, kPoint);
  EXPECT_TRUE(report.is_zero);
  EXPECT_FALSE(report.passed);
}

TEST(DerivativeCheck, RejectsZeroWhereTheFunctionChanges) {
  const DerivativeReport report = check_gradient(
      value, [](const Vector&) { return Vector::Zero(3).eval(); }, kPoint);
  EXPECT_FALSE(report.passed);
  EXPECT_NEAR(report.relative_error, 1, 1e-12);
}

TEST(DerivativeCheck, RejectsNotANumber) {
  const auto broken = [](const Vector& x) {
    Vector g = gradient(x);
    g[1] = std::numeric_limits<double>::quiet_NaN();
    return g;
  };
  EXPECT_FALSE(check_gradient(value, broken, kPoint).passed);
  const auto undefined = [](const Vector& x) { return value(x) * std::numeric_limits<double>::quiet_NaN(); };
  EXPECT_FALSE(check_gradient(undefined, gradient, kPoint).passed);
}

TEST(DerivativeCheck, RejectsTheKinkOfAnAbsoluteValue) {
  const auto kink = [](const Vector& x) { return std::abs(x[0]); };
  const auto one_sided = [](const Vector&) { return Vector::Ones(1).eval(); };
  EXPECT_FALSE(check_gradient(kink, one_sided, Vector::Zero(1)).passed);
}

TEST(DerivativeCheck, WrongSizeIsAnError) {
  EXPECT_THROW(check_gradient(
                   value, [](const Vector&) { return Vector::Ones(2).eval(); }, kPoint),
               ComputationError);
}

}  // namespace
}  // namespace polyaffine
