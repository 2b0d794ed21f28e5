#include <gtest/gtest.h>

#include <polyaffine/solve/anderson.hpp>

namespace polyaffine {
namespace {

// x ← b + A x, whose plain iteration runs away along the first direction.
Vector step_of(const Vector& x) {
  Matrix A(3, 3);
  A << -4, 0.3, 0, 0.1, 0.5, 0.2, 0, -0.3, 0.8;
  return Vector{{1, -2, 3}} + A * x - x;
}

TEST(Anderson, SolvesALinearProblemInOneStepMoreThanItHasUnknowns) {
  Anderson anderson(5);
  Vector x = Vector::Zero(3);
  for (int k = 0; k < 4; ++k) x += anderson.step(x, step_of(x));
  EXPECT_LT(step_of(x).norm(), 1e-10);
}

TEST(Anderson, WithoutMemoryIsTheFixedPointIteration) {
  Anderson none(0), forgetful(5);
  Vector x = Vector::Ones(3);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(none.step(x, step_of(x)), step_of(x));
    forgetful.forget();
    EXPECT_EQ(forgetful.step(x, step_of(x)), step_of(x));
    x += step_of(x);
  }
}

TEST(Anderson, StaysWhereItHasArrived) {
  Anderson anderson(5);
  const Vector x = Vector::Ones(3), f = Vector::Zero(3);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(anderson.step(x, f), f);  // differences without length
}

}  // namespace
}  // namespace polyaffine
