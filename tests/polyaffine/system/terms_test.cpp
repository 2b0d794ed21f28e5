#include <gtest/gtest.h>

#include <stdexcept>

#include <polyaffine/check/derivative_check.hpp>
#include <polyaffine/core/error.hpp>

#include "polyaffine/system/block_body.hpp"
#include "support/random_vector.hpp"

namespace polyaffine {
namespace {

using testing::BlockBody;
using testing::random_vector;

Vector force(const Term& term, const System& system, const Vector& y, const Vector* rate = nullptr) {
  Residual out;
  out.values = Vector::Zero(system.size());
  term.add_residual({0, y, rate}, out);
  return out.values;
}

// Against the hand calculation: the face has 1 mm², a uniform displacement u strains every spring alike.
TEST(Support, HoldsAFaceWithItsStiffnessAndDamping) {
  const BlockBody body;
  const System system = body.system({});
  const Vec3 u(0.2, -0.1, 0.05), v(1e-3, 2e-3, 0);
  const Vector y = u.replicate(body.basis.num_functions(), 1),
               rate = v.replicate(body.basis.num_functions(), 1);
  const auto sum = [&](const Vector& f) {
    return Vec3(f.reshaped(3, body.basis.num_functions()).rowwise().sum());
  };
  const auto all = body.support({.stiffness_kPa_per_mm = 3, .damping_kPa_ms_per_mm = 50});
  EXPECT_LT((sum(force(*all, system, y, &rate)) - (3 * u + 50 * v)).norm(), 1e-12);
  EXPECT_LT((sum(force(*all, system, y)) - 3 * u).norm(), 1e-12);  // nothing moves: no dashpot
  const auto normal =
      body.support({.stiffness_kPa_per_mm = 3, .damping_kPa_ms_per_mm = 50, .normals = body.end_normals()});
  EXPECT_LT((sum(force(*normal, system, y, &rate)) - (3 * u[0] + 50 * v[0]) * Vec3::UnitX()).norm(), 1e-12);
}

TEST(Support, RefusesNegativeParameters) {
  const BlockBody body;
  EXPECT_THROW(body.support({.stiffness_kPa_per_mm = -1}), InputError);
  EXPECT_THROW(body.support({.damping_kPa_ms_per_mm = -1}), InputError);
}

// Force = mass · acceleration: 2 mm³ of 1.06 mg/mm³.
TEST(Inertia, AUniformAccelerationTakesTheForceOfTheMass) {
  const BlockBody body;
  System system = body.system({});
  body.add_inertia(system);
  ASSERT_EQ(system.size(), 2 * system.layout.field().size);
  const Vec3 a(0.3, 0.1, -0.2);
  const Vector y = Vector::Zero(system.size());
  Vector rate = y;
  system.layout.find("velocity").of(rate) = a.replicate(body.basis.num_functions(), 1);
  const Vector f = system.layout.field().of(force(*system.terms.back(), system, y, &rate));
  const Vec3 total = f.reshaped(3, body.basis.num_functions()).rowwise().sum();
  EXPECT_LT((total - 2 * 1.06 * a).norm(), 1e-12);
}

// ∂R/∂θ against central differences of terms with θ ± h.
TEST(Terms, ParameterDerivativesAreThoseOfTheResidual) {
  const BlockBody body;
  const double k = 3, eta = 50, rho = 1.06;
  System layout = body.system({});
  body.add_inertia(layout);
  const Vector y = random_vector(layout.size(), 0.1, 1), rate = random_vector(layout.size(), 0.01, 2);
  const auto check = [&](const std::string& name,
                         const std::function<std::shared_ptr<const Term>(double)>& make, double value) {
    SCOPED_TRACE(name);
    const auto term = make(value);
    EXPECT_TRUE(std::ranges::count(term->parameters(), name) == 1);
    const auto report = check_jacobian([&](const Vector& x) { return force(*make(x[0]), layout, y, &rate); },
                                       [&](const Vector&) {
                                         Vector out = Vector::Zero(layout.size());
                                         term->add_parameter_derivative(name, {0, y, &rate}, out);
                                         return Matrix(out);
                                       },
                                       Vector::Constant(1, value));
    EXPECT_TRUE(report.passed) << report.relative_error;
  };
  check(
      "stiffness",
      [&](double x) {
        return body.support({x, eta});
      },
      k);
  check(
      "damping",
      [&](double x) {
        return body.support({k, x});
      },
      eta);
  check(
      "density",
      [&](double x) {
        StateLayout own = body.system({}).layout;
        return std::make_shared<Inertia>(displacement_table(body.basis, body.basis.wall_points(2)), x, 1e-3,
                                         own);
      },
      rho);
  Vector out = Vector::Zero(layout.size());
  EXPECT_THROW(body.support({k, eta})->add_parameter_derivative("density", {0, y, &rate}, out),
               std::invalid_argument);
}

TEST(PointValues, AreRememberedForTheLastTimeOnly) {
  int calls = 0;
  const PointValues values = remembered([&calls](double t) {
    ++calls;
    return Vector::Constant(2, t).eval();
  });
  EXPECT_EQ(*values(1), Vector::Constant(2, 1));
  EXPECT_EQ(*values(1), Vector::Constant(2, 1));
  EXPECT_EQ(calls, 1);
  EXPECT_EQ(*values(2), Vector::Constant(2, 2));
  EXPECT_EQ(*ramp(Vector::Zero(2), Vector::Ones(2))(0.25), Vector::Constant(2, 0.25));
}

}  // namespace
}  // namespace polyaffine
