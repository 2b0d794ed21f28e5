#include <gtest/gtest.h>

#include <cardiac/circulation/windkessel.hpp>
#include <cmath>
#include <polyaffine/core/types.hpp>
#include <polyaffine/solve/ode.hpp>

namespace cardiac {
namespace {

using polyaffine::kPi;
using polyaffine::Vector;

/// One trapezoidal step of the windkessel, whose residual is affine in p: p₁ with ṗ = (p₁ − p₀)/Δt, the
/// other terms averaged.
double trapezoidal_step(const Windkessel& w, double p0, double mean_inflow, double dt) {
  const auto residual = [&](double p1) {
    const double rate = (p1 - p0) / dt;
    return windkessel_residual(w, 0.5 * (p0 + p1), rate, mean_inflow);
  };
  const double at_zero = residual(0), slope = residual(1) - at_zero;
  return -at_zero / slope;
}

TEST(Windkessel, PublishedTwoElementValue) {
  const Windkessel w{.peripheral_resistance_kPa_ms_per_mm3 = 1e-4,
                     .compliance_mm3_per_kPa = 2000,
                     .reference_pressure_kPa = 1};
  const auto volume = [](double t) { return 0.5 * (1 - std::cos(2 * kPi * t / 0.1)) + 1; };
  const double dt = 0.01;
  double p = 10;
  for (int i = 0; i < 100; ++i) {
    const double inflow = -(volume((i + 1) * dt) - volume(i * dt)) / dt;
    p = trapezoidal_step(w, p, inflow, dt);
  }
  EXPECT_NEAR(p, 1.0608252198133676, 1e-12);  // published regression value; rounding of 100 steps
}

TEST(Windkessel, ConstantInflowRelaxesExponentially) {
  const Windkessel w{.proximal_resistance_kPa_ms_per_mm3 = 0.004,
                     .peripheral_resistance_kPa_ms_per_mm3 = 0.13,
                     .compliance_mm3_per_kPa = 9000,
                     .reference_pressure_kPa = 0.5};
  const double inflow = 90;
  const auto rate = [&](double, const Vector& p, Vector& dp) {
    dp[0] = -windkessel_residual(w, p[0], 0, inflow) / w.compliance_mm3_per_kPa;
  };
  const Vector times = Vector::LinSpaced(5, 0, 4000);
  const auto solution = polyaffine::solve_ode(rate, 0, Vector::Constant(1, 9.0), times);
  const double final = 0.5 + 0.13 * inflow;
  for (int i = 0; i < 5; ++i) {
    const double exact = final + (9 - final) * std::exp(-times[i] / (0.13 * 9000));
    EXPECT_NEAR(solution.states(0, i), exact, 1e-6);  // solver tolerance 1e-8 relative, some tens of steps
  }
  EXPECT_DOUBLE_EQ(inlet_pressure(w, 9, inflow), 9 + 0.004 * 90);
}

}  // namespace
}  // namespace cardiac
