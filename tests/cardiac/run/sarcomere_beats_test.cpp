#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include <cardiac/core/units.hpp>
#include <cardiac/run/simulate.hpp>

#include "support/contracting_heart.hpp"

namespace cardiac {
namespace {

using scene::ContractionModel;

// A coarse human left ventricle that beats, with a tension that feels the fibre.
Scene beating(ContractionModel model = ContractionModel::land_2017) {
  Scene out = testing::contracting_heart();
  out.contraction->model = model;
  out.circulation.emplace();
  out.time.max_beats = 3;
  return out;
}

VentricleSummary left(const Scene& scene) {
  const Outcome outcome = simulate(scene);
  EXPECT_TRUE(outcome.result.completed) << outcome.result.stop_reason;
  return outcome.result.ventricles.at(0);
}

// Both models feel the rate; with explicit rates steps of 10 ms would oscillate or blow up.
TEST(SarcomereBeats, TheStepHardlyChangesThePeak) {
  for (const auto model : {ContractionModel::land_2017, ContractionModel::bestel_clement_sorine}) {
    Scene scene = beating(model);
    scene.time.max_beats = 1;
    const double ten = left(scene).peak_pressure_mmHg;
    scene.time.max_step_ms = 1;
    const double one = left(scene).peak_pressure_mmHg;
    EXPECT_NEAR(ten, one, 0.005 * one);  // reached: 0.2 %
    EXPECT_GT(one, 60);
  }
}

// Frank and Starling: what more filling adds to the stroke is more where tension rises with the length.
TEST(SarcomereBeats, PreloadRaisesTheStroke) {
  const auto gain = [](bool length) {
    Scene scene = beating();
    if (!length) scene.contraction->overlap_slope = scene.contraction->calcium_slope_uM = 0;
    scene.circulation->filling_pressure_kPa = 8 * kPa_per_mmHg;
    const double low = left(scene).sv_mL;
    scene.circulation->filling_pressure_kPa = 14 * kPa_per_mmHg;
    return left(scene).sv_mL - low;
  };
  EXPECT_GT(gain(true), 2 * gain(false));
  EXPECT_GT(gain(false), 0);
}

// Correlation of pressure and volume at the end-systolic points of five afterloads.
TEST(SarcomereBeats, EndSystolicPointsLieOnALine) {
  double n = 0, p = 0, v = 0, pp = 0, vv = 0, pv = 0;
  for (const double resistance : {0.6, 0.8, 1.0, 1.4, 2.0}) {
    Scene scene = beating();
    scene.circulation->peripheral_resistance_kPa_ms_per_mm3 = resistance * resistance_per_mmHg_s_per_mL;
    const Outcome outcome = simulate(scene);
    ASSERT_TRUE(outcome.result.completed) << outcome.result.stop_reason;
    const HeartState* es = nullptr;
    for (const HeartState& step : outcome.path.steps)
      if (!es || step.pressures_kPa[0] * es->volumes_mm3[0] > es->pressures_kPa[0] * step.volumes_mm3[0])
        es = &step;
    const double P = es->pressures_kPa[0] / kPa_per_mmHg, V = es->volumes_mm3[0] / mm3_per_mL;
    n += 1, p += P, v += V, pp += P * P, vv += V * V, pv += P * V;
  }
  const double r = (n * pv - p * v) / std::sqrt((n * pp - p * p) * (n * vv - v * v));
  EXPECT_GT(r, 0.99);
}

TEST(SarcomereBeats, AMouseBeats) {
  for (const auto model : {ContractionModel::land_2017, ContractionModel::bestel_clement_sorine,
                           ContractionModel::bestel_clement_sorine_simplified}) {
    Scene scene = beating(model);
    scene.time.beat_ms = ms_per_min / 700;
    scene.activation->onset_ms = 10;
    const auto lv = left(scene);
    EXPECT_GT(lv.peak_pressure_mmHg, 60);
    EXPECT_GT(lv.sv_mL, 2);
  }
}

}  // namespace
}  // namespace cardiac
