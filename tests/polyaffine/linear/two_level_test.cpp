#include <gtest/gtest.h>

#include <vector>

#include <polyaffine/linear/two_level.hpp>

namespace polyaffine {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

// −u'' on n inner points of a line, and linear interpolation from every second one.
Sparse second_difference(int n) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i, 2.0);
    if (i > 0) entries.emplace_back(i, i - 1, -1.0);
    if (i + 1 < n) entries.emplace_back(i, i + 1, -1.0);
  }
  Sparse A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}
Sparse every_second(int n) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int c = 0; c < n / 2; ++c) {
    entries.emplace_back(2 * c, c, 0.5);
    entries.emplace_back(2 * c + 1, c, 1.0);
    if (2 * c + 2 < n) entries.emplace_back(2 * c + 2, c, 0.5);
  }
  Sparse P(n, n / 2);
  P.setFromTriplets(entries.begin(), entries.end());
  return P;
}

TEST(TwoLevel, ParabolaIsTheSolutionOfAConstantLoadForAnyNumberOfPoints) {
  for (const int n : {5, 101, 2001}) {
    TwoLevelReport report;
    const auto x =
        solve_two_level(second_difference(n), every_second(n), Vector::Ones(n), 1e-12, 60, &report);
    ASSERT_TRUE(x) << n;
    for (int i = 0; i < n; ++i)
      // condition n² times the tolerance
      EXPECT_NEAR((*x)[i], 0.5 * (i + 1) * (n - i), 1e-9 * n * n) << n << ' ' << i;
    EXPECT_LE(report.residual, 1e-12);
    EXPECT_LE(report.iterations, 20) << "not to depend on n = " << n;
  }
}

TEST(TwoLevel, WithoutTheCoarseSpaceItTakesManyMoreIterations) {
  const int n = 401;
  Sparse one(n, 1);
  one.insert(n / 2, 0) = 1;
  TwoLevelReport with, without;
  ASSERT_TRUE(solve_two_level(second_difference(n), every_second(n), Vector::Ones(n), 1e-10, 1000, &with));
  ASSERT_TRUE(solve_two_level(second_difference(n), one, Vector::Ones(n), 1e-10, 1000, &without));
  EXPECT_GT(without.iterations, 5 * with.iterations);
}

TEST(TwoLevel, NoSolutionOfAMatrixThatIsNotPositiveOrWithTooFewIterations) {
  const int n = 51;
  const Sparse negative = -second_difference(n);
  EXPECT_FALSE(solve_two_level(negative, every_second(n), Vector::Ones(n), 1e-10, 100));
  EXPECT_FALSE(solve_two_level(second_difference(n), every_second(n), Vector::Random(n), 1e-12, 1));
}

TEST(TwoLevel, NothingMovesWithoutALoad) {
  TwoLevelReport report;
  const auto x = solve_two_level(second_difference(9), every_second(9), Vector::Zero(9), 1e-12, 10, &report);
  ASSERT_TRUE(x);
  EXPECT_EQ(x->norm(), 0);
  EXPECT_EQ(report.iterations, 0);
}

}  // namespace
}  // namespace polyaffine
