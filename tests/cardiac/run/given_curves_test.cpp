#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <cardiac/activation/activation.hpp>
#include <cardiac/core/given_curve.hpp>
#include <cardiac/core/units.hpp>
#include <cardiac/run/simulate.hpp>

#include "support/contracting_heart.hpp"

namespace cardiac {
namespace {

// A coarse human left ventricle that beats once in a windkessel, and what its cavity did.
Scene beating() {
  Scene out = testing::contracting_heart();
  out.time.relative_tolerance = 1e-4;
  out.output.interval_ms = 5;
  return out;
}

const Outcome& beat() {
  static const Outcome outcome = [] {
    Scene scene = beating();
    scene.circulation.emplace();
    scene.time.max_beats = 1;
    return simulate(scene);
  }();
  return outcome;
}

GivenCavities told(bool volumes) {
  std::vector<double> times, values;
  for (const HeartState& s : beat().path.steps) {
    times.push_back(s.time_ms);
    values.push_back(volumes ? s.volumes_mm3[0] : s.pressures_kPa[0]);
  }
  return {volumes, {GivenCurve::through(times, values)}};
}

Outcome follow(const GivenCavities& given, double duration_ms) {
  Scene scene = beating();
  scene.cavities.emplace();
  scene.cavities->curves = std::make_shared<const GivenCavities>(given);
  scene.time.duration_ms = duration_ms;
  return simulate(scene);
}

double stroke_mm3() {
  double low = INFINITY, high = 0;
  for (const HeartState& s : beat().path.steps) {
    low = std::min(low, s.volumes_mm3[0]);
    high = std::max(high, s.volumes_mm3[0]);
  }
  return high - low;
}

// The pressures of a beat, given, make its volumes.
TEST(GivenCurves, PressuresOfABeatMakeItsVolumes) {
  ASSERT_TRUE(beat().result.completed) << beat().result.stop_reason;
  const Outcome outcome = follow(told(false), 800);
  ASSERT_TRUE(outcome.result.completed) << outcome.result.stop_reason;
  ASSERT_EQ(outcome.path.outputs.size(), 161U);
  ASSERT_EQ(beat().path.outputs.size(), 161U);
  for (std::size_t k = 2; k < 161; ++k)  // the beat begins in motion
    EXPECT_NEAR(outcome.path.outputs[k].volumes_mm3[0], beat().path.outputs[k].volumes_mm3[0],
                0.01 * stroke_mm3())
        << outcome.path.outputs[k].time_ms;
}

// And its volumes make its pressures.
TEST(GivenCurves, VolumesOfABeatMakeItsPressures) {
  const Outcome outcome = follow(told(true), 800);
  ASSERT_TRUE(outcome.result.completed) << outcome.result.stop_reason;
  ASSERT_EQ(outcome.path.outputs.size(), 161U);
  double peak = 0, worst = 0;
  for (std::size_t k = 2; k < 161; ++k) {
    const HeartState &a = outcome.path.outputs[k], &b = beat().path.outputs[k];
    EXPECT_NEAR(a.volumes_mm3[0], b.volumes_mm3[0], 1e-3 * stroke_mm3()) << a.time_ms;
    worst = std::max(worst, std::abs(a.pressures_kPa[0] - b.pressures_kPa[0]));
    peak = std::max(peak, b.pressures_kPa[0]);
  }
  EXPECT_LT(worst, 0.05 * peak);
}

TEST(GivenCurves, RepeatBeatByBeat) {
  std::vector<double> times, values;
  for (int i = 0; i <= 40; ++i) {
    times.push_back(20 * i);
    values.push_back((6 + 40 * std::pow(std::sin(M_PI * i / 40), 4)) * kPa_per_mmHg);
  }
  const Outcome outcome = follow({false, {GivenCurve::through(times, values, 800)}}, 1600);
  ASSERT_TRUE(outcome.result.completed) << outcome.result.stop_reason;
  ASSERT_EQ(outcome.path.outputs.size(), 321U);  // every 5 ms of two beats
  for (std::size_t k = 40; k < 160; ++k) {
    const HeartState &first = outcome.path.outputs[k], &second = outcome.path.outputs[k + 160];
    EXPECT_NEAR(first.pressures_kPa[0], second.pressures_kPa[0], 1e-12);
    EXPECT_NEAR(first.volumes_mm3[0], second.volumes_mm3[0], 0.01 * first.volumes_mm3[0]) << first.time_ms;
  }
  double low = INFINITY, high = 0;
  for (const HeartState& s : outcome.path.outputs) {
    low = std::min(low, s.volumes_mm3[0]);
    high = std::max(high, s.volumes_mm3[0]);
  }
  EXPECT_GT(high - low, 20 * mm3_per_mL);
}

// A wall that does not contract, opened and closed by its volume.
TEST(GivenCurves, APassiveWallFollowsItsVolume) {
  Scene scene = beating();
  scene.activation.reset();
  scene.contraction.reset();
  scene.cavities.emplace();
  const double rest =
      beat().model.cavity_volumes(polyaffine::Vector::Zero(beat().model.num_coefficients()))[0];
  scene.cavities->curves = std::make_shared<const GivenCavities>(
      GivenCavities{true, {GivenCurve::through({0, 200, 400}, {rest, 1.3 * rest, 1.1 * rest})}});
  scene.time.duration_ms = 400;
  const Outcome outcome = simulate(scene);
  ASSERT_TRUE(outcome.result.completed) << outcome.result.stop_reason;
  const auto& out = outcome.path.outputs;
  EXPECT_NEAR(out.front().pressures_kPa[0], 0, 1e-3);
  EXPECT_NEAR(out[40].volumes_mm3[0] / rest, 1.3, 1e-3);
  EXPECT_GT(out[40].pressures_kPa[0], 5 * out.back().pressures_kPa[0] / 2);
  EXPECT_GT(out.back().pressures_kPa[0], 0.01);
}

// The tension that the muscle's own model makes, given as a table, makes the same beat.
TEST(GivenCurves, TheTensionOfTheModelMakesItsBeat) {
  const TensionCurve& own = beat().model.contraction->curve;
  std::vector<double> times, values;
  for (int i = 0; i <= 800; ++i) {
    times.push_back(i);
    values.push_back(own.at(i).tension_kPa);
  }
  const TensionCurve given(GivenCurve::through(times, values, 800));
  EXPECT_NEAR(given.peak_tension() / own.peak_tension(), 1, 1e-4);
  EXPECT_NEAR(given.contraction_end_ms(), own.contraction_end_ms(), 1);
  for (double t = -500; t < 900; t += 33)
    EXPECT_NEAR(given.at(t).tension_kPa, own.at(t).tension_kPa, 2e-3 * own.peak_tension()) << t;
  Scene scene = beating();
  scene.circulation.emplace();
  scene.time.max_beats = 1;
  scene.contraction->model = scene::ContractionModel::table;
  scene.contraction->tension = std::make_shared<const GivenCurve>(GivenCurve::through(times, values, 800));
  const Outcome outcome = simulate(scene);
  ASSERT_TRUE(outcome.result.completed) << outcome.result.stop_reason;
  EXPECT_NEAR(outcome.result.ventricles[0].esv_mL, beat().result.ventricles[0].esv_mL, 0.2);
}

// The times of a map, at the vertices and as the model sees them.
TEST(GivenCurves, TimesOfAMapAreThoseOfTheMuscle) {
  Scene scene = beating();
  scene.circulation.emplace();
  scene.time.max_beats = 1;
  const auto& mesh = scene.heart->mesh;
  ActivationMap map{mesh.points(), polyaffine::Vector(mesh.num_points())};
  for (int i = 0; i < mesh.num_points(); ++i) map.times_ms[i] = 100 + 0.2 * mesh.points()(2, i);
  scene.activation->mode = scene::ActivationMode::array;
  scene.activation->map = std::make_shared<const ActivationMap>(map);
  const Outcome outcome = simulate(scene);
  EXPECT_EQ(outcome.model.contraction->vertex_delay_ms, map.times_ms);
  EXPECT_GT(map.times_ms.maxCoeff() - map.times_ms.minCoeff(), 5);
}

}  // namespace
}  // namespace cardiac
