#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <cardiac/core/units.hpp>
#include <cardiac/run/haemodynamics.hpp>
#include <cardiac/scene/loops.hpp>

#include "support/heart_run.hpp"

namespace cardiac {
namespace {

using ::testing::HasSubstr;
using testing::HeartRun;

const HeartRun& healthy() {
  return testing::shipped_run("healthy_lv");
}

HeartRun healthy_with(const std::vector<std::string>& overrides) {
  return {testing::shipped_protocol("healthy_lv", overrides), healthy().ventricle.anatomy};
}

struct Range {
  double low = 1e300, high = -1e300;
};

Range volumes_mL(const HeartRun& run) {
  Range out;
  for (const HeartState& s : run.path.steps) {
    out.low = std::min(out.low, s.volumes_mm3[0] / mm3_per_mL);
    out.high = std::max(out.high, s.volumes_mm3[0] / mm3_per_mL);
  }
  return out;
}

TEST(KeyStates, OfAHealthyBeatAreWhereItsValvesClose) {
  const HeartRun& run = healthy();
  const VentricleSummary& lv = run.result.ventricles[0];
  EXPECT_EQ(run.key.es_is, "closing of the outlet valve");
  // Both lie between time steps; the volumes there are the extremes, since nothing leaks.
  EXPECT_NEAR(run.key.ed.volumes_mm3[0] / mm3_per_mL, lv.edv_mL, 0.05);
  EXPECT_NEAR(run.key.es.volumes_mm3[0] / mm3_per_mL, lv.esv_mL, 0.05);
  EXPECT_NEAR(run.key.es.pressures_kPa[0], run.key.es.vessels_kPa[0], 0.05 * kPa_per_mmHg);
  EXPECT_NEAR(run.ventricle.cavity_volume(run.key.ed.c), run.key.ed.volumes_mm3[0], 0.05 * mm3_per_mL);
  // Filled at rest: at the pressure of the atrium, when the muscle begins to contract at 100 ms.
  EXPECT_NEAR(lv.edp_mmHg, 10, 0.1);
  EXPECT_NEAR(lv.ed_time_ms, 100, 5);
  EXPECT_LT(std::abs(lv.isovolumetric_contraction_change_mL), 0.1);
  EXPECT_LT(std::abs(lv.isovolumetric_relaxation_change_mL), 0.3);
}

// The wall begins its first beat in equilibrium with the atrium: the valve is never seen to close.
TEST(KeyStates, OfAFirstBeatBeginWithItsContraction) {
  const HeartRun first = healthy_with({"time.max_beats=1"});
  EXPECT_EQ(first.key.ed_is, "onset of contraction");
  EXPECT_NEAR(first.key.ed.time_ms, healthy().key.ed.time_ms, 1);
  EXPECT_NEAR(first.result.ventricles[0].edp_mmHg, 10, 0.2);  // that of the filling, as contraction begins
  for (const std::string& warning : first.result.warnings)
    EXPECT_EQ(warning.find("valve never"), std::string::npos) << warning;
}

TEST(KeyStates, DoNotHangOnTheTimeSteps) {
  const HeartRun fine = healthy_with({"time.max_step_ms=3"});
  const VentricleSummary &a = healthy().result.ventricles[0], &b = fine.result.ventricles[0];
  EXPECT_NEAR(a.edp_mmHg, b.edp_mmHg, 0.13);  // twice what is reached; time.absolute_tolerance_mmHg is 0.1
  EXPECT_NEAR(a.edv_mL, b.edv_mL, 0.2);
  EXPECT_NEAR(a.ed_time_ms, b.ed_time_ms, 1);
  EXPECT_NEAR(a.es_time_ms, b.es_time_ms, 2);
}

TEST(KeyStates, AnAorticValveThatNeverClosesLeavesTheLargestAndSmallestVolume) {
  const HeartRun run = healthy_with({"circulation.peripheral_resistance_mmHg_s_per_mL=0.05"});
  ASSERT_TRUE(run.path.completed) << run.path.stop_reason;
  const VentricleSummary& lv = run.result.ventricles[0];
  const Range volume = volumes_mL(run);
  EXPECT_NEAR(lv.edv_mL, volume.high, 0.1);
  EXPECT_NEAR(lv.esv_mL, volume.low, 0.1);
  EXPECT_NEAR(lv.ef_percent, 66, 1);
  EXPECT_LT(run.result.strain.gls_percent, -10);
  EXPECT_EQ(run.key.es_is, "smallest volume");
  EXPECT_THAT(run.result.warnings, ::testing::Contains(HasSubstr("the aortic valve never closes")));
  for (const CavitySample& s : lv.samples)
    EXPECT_TRUE(s.phase == Phase::filling || s.phase == Phase::ejection) << s.time_ms;
}

TEST(KeyStates, OfALeakingAorticValveAreTheExtremesAndTheLeakIsTold) {
  const HeartRun run = healthy_with({"circulation.aortic_leak_resistance_mmHg_s_per_mL=0.5"});
  ASSERT_TRUE(run.path.completed) << run.path.stop_reason;
  const VentricleSummary& lv = run.result.ventricles[0];
  const Range volume = volumes_mL(run);
  EXPECT_NEAR(lv.edv_mL, volume.high, 0.1);
  EXPECT_NEAR(lv.esv_mL, volume.low, 0.1);
  EXPECT_NEAR(lv.edv_mL, 128.3, 0.8);
  EXPECT_NEAR(lv.sv_mL, 81.8, 0.8);
  EXPECT_NEAR(lv.ef_percent, 63.3, 0.5);
  EXPECT_EQ(run.key.ed_is, "onset of contraction");
  EXPECT_NEAR(lv.ed_time_ms, 100, 5);
  EXPECT_LT(lv.edp_mmHg, 20);  // before the upstroke
  // Both valves are closed wherever a phase is called isovolumetric, and none of it lies before contraction.
  const LeftHeartLoop loop = left_heart_loop(*run.protocol.circulation);
  for (std::size_t k = 0; k < lv.samples.size(); ++k) {
    const HeartState& s = run.path.steps[k];
    if (lv.samples[k].phase == Phase::filling || lv.samples[k].phase == Phase::ejection) continue;
    EXPECT_GT(s.pressures_kPa[0], loop.filling_pressure_kPa) << s.time_ms;
    EXPECT_LT(s.pressures_kPa[0], s.vessels_kPa[0]) << s.time_ms;
    EXPECT_GE(s.time_ms, lv.ed_time_ms);
  }
  EXPECT_GT(lv.isovolumetric_relaxation_change_mL, 2);
  ASSERT_TRUE(lv.haemodynamics);
  const ValveVolumes &mitral = lv.haemodynamics->valves[0], &aortic = lv.haemodynamics->valves[1];
  EXPECT_EQ(aortic.name, "aortic_valve");
  // The leak of a resistance: mean of the pressure difference over the time that it is backwards.
  double leaked = 0;
  const auto& samples = run.path.circulation;
  for (std::size_t k = 1; k < samples.size(); ++k) {
    const double drop = samples[k].states[1] - samples[k].pressures_kPa[0];
    const double R = (0.5 + 0.04) * resistance_per_mmHg_s_per_mL;
    leaked += std::max(drop, 0.0) / R * (samples[k].time_ms - samples[k - 1].time_ms);
  }
  EXPECT_NEAR(aortic.regurgitant_mL, leaked / mm3_per_mL, 0.02 * aortic.regurgitant_mL);
  EXPECT_GT(aortic.regurgitant_mL, 30);
  EXPECT_NEAR(mitral.regurgitant_mL, 0, 1e-6);
  EXPECT_NEAR(mitral.forward_mL, aortic.forward_mL - aortic.regurgitant_mL, 0.02 * mitral.forward_mL);
}

TEST(LimitCycle, ASlowWindkesselComesToOneCycleFromBothSides) {
  // RC is 9.6 s, twelve beats: beat by beat the distance would shrink by a twelfth.
  for (const char* initial : {"60", "140"}) {
    const HeartRun run = healthy_with({"circulation.peripheral_resistance_mmHg_s_per_mL=1.2",
                                       "circulation.compliance_mL_per_mmHg=8",
                                       std::string("circulation.initial_aortic_pressure_mmHg=") + initial});
    ASSERT_TRUE(run.path.completed) << run.path.stop_reason;
    EXPECT_TRUE(run.path.warnings.empty());
    EXPECT_LE(run.path.beats, 7);
    EXPECT_NEAR(run.result.ventricles[0].peak_pressure_mmHg, 138.2, 2);
    // By flows alone: what the limit cycle ejects runs off.
    const Haemodynamics& h = *run.result.ventricles[0].haemodynamics;
    double run_off = 0;
    const auto& samples = run.path.circulation;
    for (std::size_t k = 1; k < samples.size(); ++k)
      run_off += (samples[k].states[1] / kPa_per_mmHg - 5) / 1.2 *
                 (samples[k].time_ms - samples[k - 1].time_ms) / 1000;
    EXPECT_NEAR(run_off, h.valves[1].forward_mL, 0.02 * run_off);
  }
}

TEST(LimitCycle, ArteriesThatNeedThousandsOfBeatsAreNotTakenForClosed) {
  const HeartRun run = healthy_with({"circulation.compliance_mL_per_mmHg=1e4", "time.max_beats=3"});
  EXPECT_EQ(run.path.beats, 3);
  EXPECT_THAT(run.path.warnings, ::testing::Contains(HasSubstr("did not close")));
}

TEST(LimitCycle, NoiseBelowATightToleranceIsNamed) {
  const HeartRun run = healthy_with(
      {"time.heart_rate_bpm=190", "time.limit_cycle_tolerance_percent=1e-7", "time.max_beats=30"});
  ASSERT_TRUE(run.path.completed) << run.path.stop_reason;
  EXPECT_LT(run.path.beats, 30);
  EXPECT_THAT(run.path.warnings,
              ::testing::Contains(::testing::AllOf(HasSubstr("noise"), HasSubstr("time.relative_tolerance"),
                                                   HasSubstr("time.absolute_tolerance_mm"),
                                                   HasSubstr("time.absolute_tolerance_mmHg"))));
}

TEST(Haemodynamics, OfAHealthyBeatObeyTheRelationsByHand) {
  const HeartRun run = healthy_with({"time.max_step_ms=2", "time.limit_cycle_tolerance_percent=0.2"});
  const VentricleSummary& lv = run.result.ventricles[0];
  ASSERT_TRUE(lv.haemodynamics);
  const Haemodynamics& h = *lv.haemodynamics;
  // Output: stroke volume times rate, nothing leaks.
  EXPECT_NEAR(h.cardiac_output_L_per_min, lv.sv_mL * 75 / 1000, 0.005 * h.cardiac_output_L_per_min);
  // Mean flow times the resistances is the mean pressure difference from the aorta to the veins.
  const double flow_mL_per_s = h.cardiac_output_L_per_min * 1000 / 60;
  EXPECT_NEAR(h.arterial_mean_mmHg - 5, flow_mL_per_s * (1.0 + 0.04), 0.01 * h.arterial_mean_mmHg);
  EXPECT_GT(h.arterial_systolic_mmHg, h.arterial_mean_mmHg);
  EXPECT_LT(h.arterial_diastolic_mmHg, h.arterial_mean_mmHg);
  EXPECT_LT(h.arterial_systolic_mmHg, lv.peak_pressure_mmHg);
  EXPECT_NEAR(h.venous_mean_mmHg, 10, 1e-9);
  // Stroke work: the area of the loop of the steps as a polygon, by the surveyor's formula.
  double area = 0;
  for (std::size_t k = 0; k < lv.samples.size(); ++k) {
    const CavitySample &a = lv.samples[k], &b = lv.samples[(k + 1) % lv.samples.size()];
    area += (a.pressure_mmHg * b.volume_mL - b.pressure_mmHg * a.volume_mL) / 2;
  }
  EXPECT_NEAR(h.stroke_work_mmHg_mL, std::abs(area), 0.005 * std::abs(area));
  EXPECT_NEAR(h.stroke_work_mJ, h.stroke_work_mmHg_mL * 0.133322387, 1e-6 * h.stroke_work_mJ);
  for (const ValveVolumes& valve : h.valves) EXPECT_LT(valve.regurgitant_mL, 1e-6);
  EXPECT_GT(h.dp_dt_max_mmHg_per_s, 300);
  EXPECT_LT(h.dp_dt_min_mmHg_per_s, -300);
}

TEST(Haemodynamics, TableHoldsWhatTheNumbersAreMadeOf) {
  const CirculationTable& table = healthy().result.circulation;
  const auto column = [&](const std::string& name) -> const std::vector<double>& {
    const auto found = std::ranges::find(table.columns, name);
    if (found == table.columns.end()) throw std::out_of_range(name);
    return table.values[static_cast<std::size_t>(found - table.columns.begin())];
  };
  const auto &t = column("time_ms"), &aorta = column("aorta_mmHg"), &out = column("aortic_valve_mL_per_s"),
             &arteries = column("systemic_arteries_mmHg"), &volume = column("left_ventricle_mL");
  ASSERT_GT(t.size(), 200U);
  EXPECT_EQ(t.front(), 0);
  EXPECT_NEAR(t.back(), 800, 1e-6);
  double ejected = 0, mean = 0;
  for (std::size_t k = 1; k < t.size(); ++k) {
    ejected += (out[k] + out[k - 1]) / 2 * (t[k] - t[k - 1]) / 1000;
    mean += (aorta[k] + aorta[k - 1]) / 2 * (t[k] - t[k - 1]) / 800;
    EXPECT_NEAR(aorta[k], arteries[k] + 0.04 * out[k], 1e-9);
  }
  const VentricleSummary& lv = healthy().result.ventricles[0];
  // Twice what is reached: flows hang on pressures, which the error test of the integration leaves out.
  EXPECT_NEAR(ejected, *std::ranges::max_element(volume) - *std::ranges::min_element(volume), 0.01 * ejected);
  EXPECT_NEAR(mean, lv.haemodynamics->arterial_mean_mmHg, 1e-6);
  for (const char* name : {"pulmonary_veins_mmHg", "left_ventricle_mmHg", "systemic_veins_mmHg",
                           "mitral_valve_mL_per_s", "systemic_vessels_mL_per_s"})
    EXPECT_EQ(column(name).size(), t.size()) << name;
}

}  // namespace
}  // namespace cardiac
