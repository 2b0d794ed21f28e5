#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <polyaffine/kinematics/lagrange.hpp>
#include <polyaffine/material/linear_elastic.hpp>
#include <polyaffine/solve/dae.hpp>
#include <polyaffine/system/field_term.hpp>
#include <polyaffine/system/inertia.hpp>
#include <polyaffine/system/support.hpp>

#include "support/labelled_box.hpp"

namespace polyaffine {
namespace {

constexpr double kYoung = 100, kDensity = 2, kLength = 4;  // kPa, mg/mm³, mm

// A bar without lateral contraction, held at x = 0, in quadratic elements.
struct Bar {
  TetMesh mesh = testing::labelled_box(Vec3::Zero(), Vec3(kLength, 1, 1), {4, 1, 1});
  LagrangeBasis basis{mesh, 2};

  System system(const Terms& more = {}) const {
    using Laws = std::vector<std::shared_ptr<const Law>>;
    System out = field_system(
        3 * basis.num_functions(),
        {solid(std::make_shared<FieldEnergy>(deformation_table(basis, basis.wall_points(3)),
                                             Laws{std::make_shared<LinearElastic>(Elasticity{kYoung, 0})}))},
        {}, 1e-7);
    out.terms.insert(out.terms.end(), more.begin(), more.end());
    out.terms.push_back(std::make_shared<Inertia>(displacement_table(basis, basis.wall_points(4)), kDensity,
                                                  1e-7, out.layout));
    out.fixed.assign(3 * basis.num_functions(), 0);
    for (const int node : basis.surface_nodes(mesh, {testing::kXLow}))
      for (int k = 0; k < 3; ++k) out.fixed[3 * node + k] = 1;
    return out;
  }
  // The first mode, u = A sin(π x / 2L), at rest.
  Vector mode(const System& system, double A) const {
    Vector y = Vector::Zero(system.size());
    for (int n = 0; n < basis.num_functions(); ++n)
      y[3 * n] = A * std::sin(std::numbers::pi * basis.nodes()(0, n) / (2 * kLength));
    return y;
  }
};

// Of a bar held at one end, ω = π/2L √(E/ρ).
const double kPeriod =
    2 * std::numbers::pi / (std::numbers::pi / (2 * kLength) * std::sqrt(kYoung / kDensity));

double cosine_of(const Bar& bar, const System& system, const Vector& y) {
  const Vector mode = bar.mode(system, 1);
  const Unknowns c = system.layout.field();
  return c.of(mode).dot(c.of(y)) / c.of(mode).squaredNorm();
}

TEST(Vibration, ABarSwingsWithItsFirstFrequency) {
  const Bar bar;
  const System system = bar.system();
  const Vector y = bar.mode(system, 0.01);
  // The acceleration of the mode, −ω² u.
  Vector rate = Vector::Zero(system.size());
  const double omega = 2 * std::numbers::pi / kPeriod;
  system.layout.find("velocity").of(rate) = -omega * omega * system.layout.field().of(y);
  DaeIntegrator ida(system, {.relative_tolerance = 1e-7, .max_step = kPeriod / 200}, 0, y, rate);
  for (const auto& [share, expected] : {std::pair{0.25, 0.0}, {0.5, -1.0}, {1.0, 1.0}, {2.25, 0.0}}) {
    while (ida.time() < share * kPeriod) ASSERT_EQ(ida.step(share * kPeriod), DaeStatus::reached);
    // Four quadratic elements a quarter wave have the frequency to 2e-5; BDF of order 5 damps less than that.
    EXPECT_NEAR(cosine_of(bar, system, ida.y()) / 0.01, expected, 1e-3) << share;
  }
}

TEST(Vibration, DashpotsAtItsEndTakeTheWaveOut) {
  // A dashpot of the bar's impedance √(E ρ) at the end lets no wave back: after the way to the end and back,
  // 2L/√(E/ρ), half a period, little is left.
  const Bar bar;
  const double impedance = std::sqrt(kYoung * kDensity);
  const System system = bar.system({std::make_shared<Support>(
      displacement_table(bar.basis, bar.basis.surface_points(bar.mesh, {testing::kXHigh}, 4)),
      SupportParameters{.damping_kPa_ms_per_mm = impedance})});
  const Vector y = bar.mode(system, 0.01);
  DaeIntegrator ida(system, {.relative_tolerance = 1e-6, .max_step = kPeriod / 100}, 0, y,
                    Vector::Zero(system.size()));
  while (ida.time() < 0.75 * kPeriod) ASSERT_EQ(ida.step(0.75 * kPeriod), DaeStatus::reached);
  EXPECT_LT(std::abs(cosine_of(bar, system, ida.y())) / 0.01, 0.02);
}

}  // namespace
}  // namespace polyaffine
