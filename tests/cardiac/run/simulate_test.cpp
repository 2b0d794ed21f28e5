#include "cardiac/run/simulate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include <cardiac/core/units.hpp>
#include <cardiac/model/coupled_heart.hpp>
#include <polyaffine/core/error.hpp>

#include "support/contracting_heart.hpp"
#include "support/heart_run.hpp"

namespace cardiac {
namespace {

using ::testing::HasSubstr;

// A scene put together in C++: a coarse human left ventricle that beats.
Scene beating() {
  Scene out = testing::contracting_heart();
  out.circulation.emplace();
  out.time.max_beats = 1;
  return out;
}

double ejection(const Outcome& outcome) {
  return outcome.result.ventricles.at(0).ef_percent;
}

double peak_mmHg(const Outcome& outcome) {
  return outcome.result.ventricles.at(0).peak_pressure_mmHg;
}

TEST(Simulate, ASceneOfCppBeats) {
  int built = 0, solved = 0;
  const Outcome outcome =
      simulate(beating(), {.on_built = [&] { ++built; }, .on_solved = [&] { solved += built; }});
  ASSERT_TRUE(outcome.result.completed) << outcome.result.stop_reason;
  EXPECT_EQ(built, 1);
  EXPECT_EQ(solved, 1);
  EXPECT_GT(ejection(outcome), 45);
  EXPECT_LT(ejection(outcome), 70);
  EXPECT_EQ(outcome.result.segments.size(), 17U);
  EXPECT_EQ(outcome.nodes.size(), 17U);
}

TEST(Simulate, ASceneWithoutAHeartIsRefused) {
  try {
    simulate(Scene());
    FAIL();
  } catch (const polyaffine::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("no heart"));
  }
}

// 1.06 g/mL under accelerations of some 0.1 mm/ms² per 100 ms are pressures of 0.01 kPa: the beat stays.
TEST(Simulate, InertiaHardlyChangesABeatButIsThere) {
  Scene scene = beating();
  const Outcome without = simulate(scene);
  scene.tissue.density_mg_per_mm3 = 1.06;
  const Outcome with = simulate(scene);
  ASSERT_TRUE(with.result.completed) << with.result.stop_reason;
  EXPECT_TRUE(with.model.built.contains("inertia"));
  EXPECT_FALSE(without.model.built.contains("inertia"));
  EXPECT_NEAR(ejection(with), ejection(without), 0.5);
  EXPECT_NE(ejection(with), ejection(without));
  // A hundred times as heavy it does.
  scene.tissue.density_mg_per_mm3 = 100;
  const Outcome heavy = simulate(scene, {.keep_absurd = true});
  ASSERT_TRUE(heavy.path.completed) << heavy.path.stop_reason;
  EXPECT_GT(std::abs(ejection(heavy) - ejection(without)), 2 * std::abs(ejection(with) - ejection(without)));
}

// Dashpots of the pericardium take up work that the pressure then lacks; springs hold the wall back.
TEST(Simulate, SupportsOfTheEpicardiumActOverTime) {
  Scene scene = beating();
  const Outcome unheld = simulate(scene);
  const double free = ejection(unheld);
  scene.boundary.epicardial_damping_kPa_ms_per_mm = 50;
  const Outcome damped = simulate(scene);
  ASSERT_TRUE(damped.result.completed) << damped.result.stop_reason;
  EXPECT_LT(peak_mmHg(damped), peak_mmHg(unheld) - 2);
  scene.boundary.epicardial_damping_kPa_ms_per_mm = 0;
  scene.boundary.epicardial_stiffness_kPa_per_mm = 0.2;
  const double held = ejection(simulate(scene));
  EXPECT_LT(held, free - 0.5);
  // In all directions they hold the twist and the way of the base besides.
  scene.boundary.epicardial_directions = scene::SupportDirections::all;
  const Outcome all = simulate(scene);
  ASSERT_TRUE(all.result.completed) << all.result.stop_reason;
  EXPECT_LT(ejection(all), held);
}

// The derivative of the coupled residual by a parameter of a support, through the System.
TEST(Simulate, TheModelOffersDerivativesByParameters) {
  Scene scene = beating();
  scene.boundary.epicardial_stiffness_kPa_per_mm = 0.2;
  const Outcome outcome = simulate(scene);
  ASSERT_EQ(outcome.model.supports.size(), 1U);
  const polyaffine::Vector c = outcome.path.steps.back().c;
  polyaffine::Vector by_stiffness = polyaffine::Vector::Zero(c.size());
  outcome.model.supports[0]->add_parameter_derivative("stiffness", {0, c}, by_stiffness);
  polyaffine::Residual force;
  force.values = polyaffine::Vector::Zero(c.size());
  outcome.model.supports[0]->add_residual({0, c}, force);
  EXPECT_LT((0.2 * by_stiffness - force.values).norm(), 1e-12 * force.values.norm());
  EXPECT_GT(force.values.norm(), 0);
}

}  // namespace
}  // namespace cardiac
