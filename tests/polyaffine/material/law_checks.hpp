#pragma once

#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <polyaffine/check/derivative_check.hpp>
#include <polyaffine/material/law.hpp>

/// Properties that every material law must have, checked on seeded random states.
namespace polyaffine::checks {

using Mat9 = Eigen::Matrix<double, 9, 9>;

inline Mat3 random_matrix(std::mt19937& generator, double size) {
  std::uniform_real_distribution<double> uniform(-size, size);
  Mat3 m;
  for (double& entry : m.reshaped()) entry = uniform(generator);
  return m;
}

inline Mat3 random_rotation(std::mt19937& generator) {
  std::normal_distribution<double> normal;
  Eigen::Quaterniond q;
  for (double& entry : q.coeffs()) entry = normal(generator);
  return q.normalized().toRotationMatrix();
}

/// A rotation times a stretch with entries up to 0.25 off the identity, det F between 0.4 and 1.8.
inline Mat3 random_deformation(std::mt19937& generator) {
  for (;;) {
    const Mat3 F = random_rotation(generator) * (Mat3::Identity() + random_matrix(generator, 0.25));
    const double J = F.determinant();
    if (J > 0.4 && J < 1.8) return F;
  }
}

struct Response {
  double W = 0;
  Mat3 P = Mat3::Zero();
  Mat9 A = Mat9::Zero();
};

inline Response respond(const Law& law, const Mat3& F, int point = 0, PointState state = {}) {
  Response r;
  law.evaluate(point, 1, F.data(), state, &r.W, r.P.data(), r.A.data());
  return r;
}

/// Cauchy stress P Fᵀ / J.
inline Mat3 cauchy(const Law& law, const Mat3& F) {
  return respond(law, F).P * F.transpose() / F.determinant();
}

/// P and A against central differences of W and P; A symmetric.
inline void expect_derivatives(const Law& law, int points, PointState state = {}) {
  std::mt19937 generator(7);
  DerivativeCheckOptions options;
  options.tolerance = 1e-7;  // central differences at their best step reach 1e-9 of the largest entry
  for (int point = 0; point < points; ++point) {
    const Vector x = random_deformation(generator).reshaped();
    const auto at = [&](const Vector& F) { return respond(law, F.reshaped(3, 3), point, state); };
    const DerivativeReport stress =
        check_gradient([&](const Vector& F) { return at(F).W; },
                       [&](const Vector& F) { return Vector(at(F).P.reshaped()); }, x, options);
    EXPECT_TRUE(stress.passed) << "P: " << stress.relative_error << " magnitude " << stress.magnitude;
    const DerivativeReport tangent =
        check_jacobian([&](const Vector& F) { return Vector(at(F).P.reshaped()); },
                       [&](const Vector& F) { return Matrix(at(F).A); }, x, options);
    EXPECT_TRUE(tangent.passed) << "A: " << tangent.relative_error << " magnitude " << tangent.magnitude;
    EXPECT_EQ(at(x).A, at(x).A.transpose());
  }
}

/// W(QF) = W(F) and P(QF) = Q P(F).
inline void expect_objective(const Law& law, PointState state = {}) {
  std::mt19937 generator(11);
  for (int i = 0; i < 10; ++i) {
    const Mat3 F = random_deformation(generator), Q = random_rotation(generator);
    const Response at_F = respond(law, F, 0, state), at_QF = respond(law, Q * F, 0, state);
    const double scale = at_F.P.norm();  // the errors are a few roundings of the stress
    EXPECT_NEAR(at_QF.W, at_F.W, 1e-11 * scale);
    EXPECT_LT((at_QF.P - Q * at_F.P).norm(), 1e-11 * scale);
  }
}

/// No energy and no stress at the identity and under rigid rotations; `stiffness` in kPa sets the scale of
/// the rounding error.
inline void expect_stress_free(const Law& law, double stiffness) {
  std::mt19937 generator(13);
  EXPECT_NEAR(respond(law, Mat3::Identity()).W, 0, 1e-15 * stiffness);
  EXPECT_LT(respond(law, Mat3::Identity()).P.norm(), 1e-14 * stiffness);
  for (int i = 0; i < 5; ++i) {
    const Response r = respond(law, random_rotation(generator));
    EXPECT_NEAR(r.W, 0, 1e-14 * stiffness);
    EXPECT_LT(r.P.norm(), 1e-13 * stiffness);
  }
}

/// W(sF) = W(F), and no work in a change of volume: P:F = 0.
inline void expect_isochoric(const Law& law) {
  std::mt19937 generator(17);
  for (int i = 0; i < 10; ++i) {
    const Mat3 F = random_deformation(generator);
    const Response r = respond(law, F);
    const double scale = r.P.norm();
    EXPECT_GT(scale, 1e-6);
    EXPECT_NEAR(respond(law, 1.7 * F).W, r.W, 1e-12 * scale);
    EXPECT_NEAR(r.P.cwiseProduct(F).sum(), 0, 1e-12 * scale);
  }
}

/// A batch of any length equals its points one at a time, adds to what the outputs hold, and skips null
/// outputs. `points`: number of points the law (and the state) has data for.
inline void expect_batches_equal_points(const Law& law, int points, PointState state = {}) {
  std::mt19937 generator(19);
  for (int first = 0; first < 2; ++first)
    for (int count = 1; first + count <= points; ++count) {
      std::vector<double> F, W(count, 1.0), P(9 * count, 2.0), A(81 * count, 3.0), only_P(9 * count, 0.0);
      for (int i = 0; i < count; ++i) {
        const Mat3 m = random_deformation(generator);
        F.insert(F.end(), m.data(), m.data() + 9);
      }
      law.evaluate(first, count, F.data(), state, W.data(), P.data(), A.data());
      law.evaluate(first, count, F.data(), state, nullptr, only_P.data(), nullptr);
      for (int i = 0; i < count; ++i) {
        const Response single = respond(law, Mat3(F.data() + 9 * i), first + i, state);
        const double scale = 1 + single.A.norm();  // identical arithmetic apart from the addition of 1, 2, 3
        EXPECT_NEAR(W[i] - 1, single.W, 1e-14 * scale);
        EXPECT_LT((Mat3(P.data() + 9 * i) - Mat3::Constant(2) - single.P).norm(), 1e-14 * scale);
        EXPECT_LT((Mat9(A.data() + 81 * i) - Mat9::Constant(3) - single.A).norm(), 1e-14 * scale);
        EXPECT_EQ(Mat3(only_P.data() + 9 * i), single.P);
      }
    }
}

/// F of an isochoric uniaxial stretch along the first axis, and of a simple shear in the plane of the first
/// two.
inline Mat3 uniaxial(double stretch) {
  return Vec3(stretch, 1 / std::sqrt(stretch), 1 / std::sqrt(stretch)).asDiagonal();
}
inline Mat3 simple_shear(double amount) {
  Mat3 F = Mat3::Identity();
  F(0, 1) = amount;
  return F;
}

}  // namespace polyaffine::checks
