#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include <polyaffine/kinematics/lagrange.hpp>
#include <polyaffine/material/neo_hookean.hpp>
#include <polyaffine/material/springs.hpp>
#include <polyaffine/material/viscosity.hpp>
#include <polyaffine/solve/dae.hpp>
#include <polyaffine/system/field_term.hpp>

#include "support/labelled_box.hpp"

namespace polyaffine {
namespace {

constexpr double kEnd = 20;  // ms

// A term whose pressures stay in the condensed form.
class Condensed : public Term {
 public:
  explicit Condensed(std::shared_ptr<const Term> of) : of_(std::move(of)) {}
  void add_residual(const At& at, Residual& out) const override { of_->add_residual(at, out); }
  void add_tangent(const At& at, double alpha, Tangent& out) const override {
    of_->add_tangent(at, alpha, out);
  }

 private:
  std::shared_ptr<const Term> of_;
};

// A nearly incompressible viscous bar, clamped at one end, that a traction on the other bends to and fro.
System bending(double kappa, bool condensed, double tolerance_mm) {
  const TetMesh mesh = testing::labelled_box(Vec3::Zero(), Vec3(3, 1, 1), {3, 1, 1}, 0.1);
  const LagrangeBasis basis(mesh, 2);
  FieldTable table = deformation_table(basis, basis.wall_points(3));
  const PressureSpace space = block_pressure(table, kappa);
  using Laws = std::vector<std::shared_ptr<const Law>>;
  std::shared_ptr<const Term> wall = solid(std::make_shared<FieldEnergy>(
      std::move(table), Laws{std::make_shared<NeoHookean>(Lame{0, 10}), std::make_shared<KelvinVoigt>(20)},
      space));
  if (condensed) wall = std::make_shared<Condensed>(std::move(wall));
  auto traction = std::make_shared<FieldEnergy>(
      displacement_table(basis, basis.surface_points(mesh, {testing::kXHigh}, 2)),
      Laws{std::make_shared<DeadTraction>(Vec3(0, 0, 0.8))});
  System out = field_system(3 * basis.num_functions(),
                            {wall, load(std::move(traction), [](double t) { return std::sin(t / 3); })}, {},
                            tolerance_mm);
  out.fixed.assign(3 * basis.num_functions(), 0);
  for (const int node : basis.surface_nodes(mesh, {testing::kXLow}))
    for (int k = 0; k < 3; ++k) out.fixed[3 * node + k] = 1;
  return out;
}

struct Bent {
  Vector c;
  DaeCounters counters;
};

Bent bend(double kappa, bool condensed, double tolerance) {
  const System system = bending(kappa, condensed, tolerance);
  const Vector rest = Vector::Zero(system.size());
  DaeIntegrator ida(system, {.relative_tolerance = tolerance}, 0, rest, rest);
  while (ida.time() < kEnd)
    if (ida.step(kEnd) == DaeStatus::failed) return {};
  Vector at;
  ida.interpolate(kEnd, at);
  EXPECT_EQ(at, ida.y());
  EXPECT_EQ(ida.rate().size(), system.size());
  return {ida.y(), ida.counters()};
}

// Errors of the steps and of Newton's method add up over the steps.
constexpr double kSum = 200;

TEST(MixedDae, MovesAsTheCondensedForm) {
  for (const double kappa : {1e2, 1e4}) {
    const double tolerance = 1e-6;
    const Bent condensed = bend(kappa, true, tolerance), mixed = bend(kappa, false, tolerance);
    ASSERT_EQ(mixed.c.size(), condensed.c.size());
    ASSERT_GT(mixed.c.cwiseAbs().maxCoeff(), 0.2);
    EXPECT_LT((mixed.c - condensed.c).cwiseAbs().maxCoeff(), kSum * tolerance) << kappa;
  }
}

// Where the volume is stiff a former tangent serves only the mixed form.
TEST(MixedDae, NeedsFewerFactorisationsThanTheCondensedForm) {
  for (const double tolerance : {1e-4, 1e-5, 1e-6}) {
    const DaeCounters condensed = bend(1e4, true, tolerance).counters,
                      mixed = bend(1e4, false, tolerance).counters;
    EXPECT_LT(1.5 * static_cast<double>(mixed.factorisations), static_cast<double>(condensed.factorisations));
    EXPECT_LT(1.5 * static_cast<double>(mixed.convergence_failures),
              static_cast<double>(condensed.convergence_failures));
  }
}

TEST(MixedDae, AStifferVolumeNeedsNoMoreFactorisations) {
  const Bent soft = bend(1e3, false, 1e-4), stiff = bend(1e6, false, 1e-4);
  ASSERT_GT(stiff.c.size(), 0);
  EXPECT_LE(static_cast<double>(stiff.counters.factorisations),
            1.3 * static_cast<double>(soft.counters.factorisations));
}

}  // namespace
}  // namespace polyaffine
