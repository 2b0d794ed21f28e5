#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <cardiac/anatomy/segments.hpp>
#include <cardiac/core/units.hpp>
#include <cardiac/scene/loops.hpp>
#include <cardiac/strain/peaks.hpp>

#include "support/heart_run.hpp"

namespace cardiac {
namespace {

using testing::HeartRun;

const HeartRun& healthy() {
  return testing::shipped_run("healthy_lv");
}

TEST(HealthyVentricle, CompletesWithAClosedLoop) {
  const HeartPath& path = healthy().path;
  EXPECT_TRUE(path.completed) << path.stop_reason;
  EXPECT_TRUE(path.warnings.empty());
  ASSERT_GE(path.beats, 2);
  ASSERT_EQ(path.stroke_volumes_mm3.size(), path.beats);
  const double last = path.stroke_volumes_mm3.back();
  EXPECT_LT(std::abs(path.stroke_volumes_mm3[path.beats - 2] - last), 0.01 * last);
  EXPECT_NEAR(path.simulated_ms, path.beats * 800.0, 1e-6);  // 75 beats a minute
  EXPECT_NEAR(path.steps.front().time_ms, 0, 1e-9);
  EXPECT_NEAR(path.steps.back().time_ms, 800, 1e-6);
  ASSERT_EQ(path.outputs.size(), 81);
  for (std::size_t k = 0; k < path.outputs.size(); ++k)
    EXPECT_NEAR(path.outputs[k].time_ms, 10.0 * static_cast<double>(k), 1e-6);
}

TEST(HealthyVentricle, VolumesAndPressuresArePhysiological) {
  const BeatResult& r = healthy().result;
  ASSERT_EQ(r.ventricles.size(), 1);
  const VentricleSummary& lv = r.ventricles[0];
  EXPECT_GE(lv.ef_percent, 50);
  EXPECT_LE(lv.ef_percent, 70);
  EXPECT_GE(lv.peak_pressure_mmHg, 105);
  EXPECT_LE(lv.peak_pressure_mmHg, 140);
  EXPECT_GE(lv.edp_mmHg, 4);
  EXPECT_LE(lv.edp_mmHg, 14);
  EXPECT_NEAR(lv.sv_mL, lv.edv_mL - lv.esv_mL, 1e-9);
  EXPECT_LT(lv.ed_time_ms, lv.es_time_ms);
}

TEST(HealthyVentricle, DeformationIsPhysiological) {
  const BeatResult& r = healthy().result;
  EXPECT_GE(r.strain.gls_percent, -25);
  EXPECT_LE(r.strain.gls_percent, -12);
  EXPECT_LT(r.strain.gcs_percent, -10);
  EXPECT_GT(r.strain.grs_percent, 15);
  EXPECT_GE(r.strain.twist_deg, 4);
  EXPECT_LE(r.strain.twist_deg, 25);
  EXPECT_GT(r.min_det_F, 0.5);
  EXPECT_LT(r.max_det_F, 1.5);
}

TEST(HealthyVentricle, EverySegmentShortensAndThickens) {
  const BeatResult& r = healthy().result;
  const auto& lv = r.ventricles[0];
  const auto peaks = strain_peaks(r.instants, lv.ed_time_ms, lv.es_time_ms);
  ASSERT_EQ(peaks.size(), kAhaSegments);
  for (int s = 1; s <= 16; ++s) {
    SCOPED_TRACE(aha_name(s));
    EXPECT_LT(peaks[s - 1].circumferential.systolic, -0.08);
    EXPECT_LT(peaks[s - 1].longitudinal.systolic, -0.05);
    EXPECT_GT(peaks[s - 1].radial.systolic, 0.08);
  }
  EXPECT_LT(peaks[16].circumferential.systolic, -0.02);  // the cap, where directions mean little
}

TEST(HealthyVentricle, NothingIsNotANumber) {
  for (const auto* states : {&healthy().path.steps, &healthy().path.outputs})
    for (const HeartState& s : *states) {
      ASSERT_TRUE(s.c.allFinite());
      ASSERT_TRUE(std::isfinite(s.time_ms + s.volumes_mm3[0] + s.pressures_kPa[0] + s.vessels_kPa[0]));
    }
  const BeatResult& r = healthy().result;
  ASSERT_EQ(r.instants.size(), healthy().path.outputs.size());
  for (const Instant& instant : r.instants) {
    ASSERT_EQ(instant.strain.size(), kAhaSegments);
    ASSERT_EQ(instant.frames.size(), kAhaSegments);
    for (const SegmentStrain& e : instant.strain)
      ASSERT_TRUE(std::isfinite(e.longitudinal + e.circumferential + e.radial + e.shear_lc + e.shear_lr +
                                e.shear_cr + e.volume_ratio));
    for (const SegmentFrame& f : instant.frames) ASSERT_TRUE(f.A.allFinite() && f.t.allFinite());
  }
  for (const SegmentInfo& s : r.segments) {
    ASSERT_TRUE(std::isfinite(s.volume_mL) && s.volume_mL > 0);
    ASSERT_TRUE(s.activation_ms && std::isfinite(*s.activation_ms));
  }
}

TEST(HealthyVentricle, PhasesFollowInOrderEachOnce) {
  const auto& samples = healthy().result.ventricles[0].samples;
  std::vector<Phase> order;
  for (const CavitySample& s : samples)
    if (order.empty() || order.back() != s.phase) order.push_back(s.phase);
  // The beat begins and ends while the ventricle fills.
  EXPECT_EQ(order, (std::vector<Phase>{Phase::filling, Phase::isovolumetric_contraction, Phase::ejection,
                                       Phase::isovolumetric_relaxation, Phase::filling}));
}

TEST(HealthyVentricle, VolumeIsConstantInBothIsovolumetricPhases) {
  const VentricleSummary& lv = healthy().result.ventricles[0];
  for (const Phase phase : {Phase::isovolumetric_contraction, Phase::isovolumetric_relaxation}) {
    double low = 1e300, high = -1e300, first = 0, last = 0;
    for (const CavitySample& s : lv.samples) {
      if (s.phase != phase) continue;
      if (high < low) first = s.pressure_mmHg;
      last = s.pressure_mmHg;
      low = std::min(low, s.volume_mL);
      high = std::max(high, s.volume_mL);
    }
    EXPECT_LT(high - low, 0.005 * lv.edv_mL);
    // What keeps the volume is the valves: meanwhile the pressure runs between filling and arteries.
    EXPECT_GT(std::abs(last - first), 30);
    EXPECT_EQ(last > first, phase == Phase::isovolumetric_contraction);
  }
}

TEST(HealthyVentricle, CirculationConservesVolume) {
  // Steps short enough for trapezoids, which are of lower order than the solver and miss most where valves
  // open (0.5 % with 2 ms).
  const HeartRun run(testing::shipped_protocol("healthy_lv", {"time.max_step_ms=1"}),
                     healthy().ventricle.anatomy);
  const LeftHeartLoop loop = left_heart_loop(*run.protocol.circulation);
  double mitral = 0, aortic = 0, peripheral = 0;
  const auto& steps = run.path.steps;
  for (std::size_t k = 1; k < steps.size(); ++k) {
    const double half = (steps[k].time_ms - steps[k - 1].time_ms) / 2;
    for (const HeartState& s : {steps[k - 1], steps[k]}) {
      const LoopFlows q = loop_flows(loop, s.pressures_kPa[0], s.vessels_kPa[0]);
      mitral += half * q.mitral_mm3_per_ms;
      aortic += half * q.aortic_mm3_per_ms;
      peripheral += half * (s.vessels_kPa[0] - loop.arteries.reference_pressure_kPa) /
                    loop.arteries.peripheral_resistance_kPa_ms_per_mm3;
    }
  }
  const double sv = run.path.stroke_volumes_mm3.back();
  const double tolerance = 0.005 * sv;
  EXPECT_NEAR(mitral - aortic, steps.back().volumes_mm3[0] - steps.front().volumes_mm3[0], tolerance);
  EXPECT_NEAR(
      aortic - peripheral,
      loop.arteries.compliance_mm3_per_kPa * (steps.back().vessels_kPa[0] - steps.front().vessels_kPa[0]),
      tolerance);
  EXPECT_NEAR(aortic, sv, tolerance);
  EXPECT_NEAR(mitral, aortic, 0.01 * sv);  // a limit cycle, to the tolerance asked for
}

TEST(HealthyVentricle, VolumeUnknownIsTheVolumeOfTheCavity) {
  const HeartRun& run = healthy();
  for (std::size_t k = 0; k < run.path.steps.size(); k += 5) {
    const HeartState& s = run.path.steps[k];
    EXPECT_NEAR(run.ventricle.cavity_volume(s.c), s.volumes_mm3[0],
                0.02 * mm3_per_mL);  // twice its tolerance
  }
}

TEST(HealthyVentricle, TighterTolerancesLeaveTheEjectionFraction) {
  const HeartRun& run = healthy();
  const HeartRun tight(testing::shipped_protocol(
                           "healthy_lv", {"time.relative_tolerance=1e-5", "time.absolute_tolerance_mm=1e-4",
                                          "time.absolute_tolerance_mmHg=1e-3"}),
                       run.ventricle.anatomy);
  ASSERT_TRUE(tight.path.completed) << tight.path.stop_reason;
  EXPECT_GT(tight.path.time_steps * run.path.beats, 1.2 * run.path.time_steps * tight.path.beats);
  EXPECT_NEAR(tight.result.ventricles[0].ef_percent, run.result.ventricles[0].ef_percent, 0.2);
}

}  // namespace
}  // namespace cardiac
