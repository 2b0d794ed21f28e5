#include <polyaffine/core/error.hpp>
#include <polyaffine/material/viscosity.hpp>

#include "polyaffine/material/law_checks.hpp"

namespace polyaffine {
namespace {

using namespace checks;

constexpr double kViscosity = 3.5;

Mat3 stress(const Mat3& F, const Mat3& F_dot) {
  Mat3 P = Mat3::Zero();
  KelvinVoigt(kViscosity).evaluate(0, 1, F.data(), F_dot.data(), P.data(), nullptr);
  return P;
}

TEST(KelvinVoigt, TangentsAreDerivatives) {
  std::mt19937 generator(3);
  for (int i = 0; i < 5; ++i) {
    const Mat3 F = random_deformation(generator), F_dot = random_matrix(generator, 0.4);
    Mat9 A_dot = Mat9::Zero(), A = Mat9::Zero();
    KelvinVoigt(kViscosity).evaluate(0, 1, F.data(), F_dot.data(), nullptr, A_dot.data(), A.data());
    const auto by_rate =
        check_jacobian([&](const Vector& x) { return Vector(stress(F, x.reshaped(3, 3)).reshaped()); },
                       [&](const Vector&) { return Matrix(A_dot); }, F_dot.reshaped());
    EXPECT_TRUE(by_rate.passed) << by_rate.relative_error;
    const auto by_F =
        check_jacobian([&](const Vector& x) { return Vector(stress(x.reshaped(3, 3), F_dot).reshaped()); },
                       [&](const Vector&) { return Matrix(A); }, F.reshaped());
    EXPECT_TRUE(by_F.passed) << by_F.relative_error;
    EXPECT_LT((A_dot - A_dot.transpose()).norm(), 1e-14 * A_dot.norm());
  }
}

TEST(KelvinVoigt, NoStressInARigidMotion) {
  std::mt19937 generator(4);
  const Mat3 F = random_deformation(generator), B = random_matrix(generator, 1);
  const Mat3 spin = B - B.transpose();
  EXPECT_LT(stress(F, spin * F).norm(), 1e-14 * spin.norm() * kViscosity);
}

TEST(KelvinVoigt, DissipatesTheSquareOfTheStrainRate) {
  std::mt19937 generator(5);
  const Mat3 F = random_deformation(generator), F_dot = random_matrix(generator, 1);
  const Mat3 E_dot = 0.5 * (F.transpose() * F_dot + F_dot.transpose() * F);
  EXPECT_NEAR(stress(F, F_dot).cwiseProduct(F_dot).sum(), kViscosity * E_dot.squaredNorm(), 1e-12);
  EXPECT_GT(E_dot.norm(), 0.1);
}

TEST(KelvinVoigt, BatchEqualsPointsAndFactorScales) {
  std::mt19937 generator(6);
  const std::vector<double> factor = {1, 2, 3, 4, 5, 6, 7};
  std::vector<double> F, F_dot;
  for (int i = 0; i < 6; ++i) {
    const Mat3 f = random_deformation(generator), g = random_matrix(generator, 1);
    F.insert(F.end(), f.data(), f.data() + 9);
    F_dot.insert(F_dot.end(), g.data(), g.data() + 9);
  }
  for (int count = 1; count <= 6; ++count) {
    std::vector<double> P(9 * count);
    KelvinVoigt(kViscosity, factor).evaluate(1, count, F.data(), F_dot.data(), P.data(), nullptr);
    for (int i = 0; i < count; ++i) {
      const Mat3 single = stress(Mat3(F.data() + 9 * i), Mat3(F_dot.data() + 9 * i));
      EXPECT_LT((Mat3(P.data() + 9 * i) - (i + 2) * single).norm(), 1e-13 * (i + 2) * kViscosity);
    }
  }
}

TEST(KelvinVoigt, NegativeViscosityIsRefused) {
  EXPECT_THROW(KelvinVoigt(-1), InputError);
  EXPECT_THROW(KelvinVoigt(1, {1, -2}), InputError);
}

}  // namespace
}  // namespace polyaffine
