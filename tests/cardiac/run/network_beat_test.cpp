#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <cardiac/circulation/network.hpp>
#include <cardiac/core/units.hpp>
#include <cardiac/run/simulate.hpp>
#include <cardiac/scene/loops.hpp>
#include <polyaffine/core/error.hpp>

#include "support/contracting_heart.hpp"

namespace cardiac {
namespace {

// A coarse human left ventricle that beats.
Scene beating() {
  Scene out = testing::contracting_heart();
  out.circulation.emplace();
  return out;
}

const VentricleSummary& lv(const Outcome& outcome) {
  return outcome.result.ventricles.at(0);
}

std::vector<double> column(const Outcome& outcome, const std::string& name) {
  const CirculationTable& table = outcome.result.circulation;
  const auto found = std::ranges::find(table.columns, name);
  EXPECT_NE(found, table.columns.end()) << name;
  if (found == table.columns.end()) return {};
  return table.values[static_cast<std::size_t>(found - table.columns.begin())];
}

TEST(NetworkBeat, OfAWindkesselIsThatOfTheOneBuiltIn) {
  Scene scene = beating();
  scene.time.max_beats = 2;
  const Outcome built_in = simulate(scene);
  ASSERT_TRUE(built_in.result.completed) << built_in.result.stop_reason;
  const auto& c = *scene.circulation;
  scene.circulation->network = std::make_shared<const CirculationNetwork>(
      network_of(left_heart_loop(c), c.initial_aortic_pressure_kPa));
  const Outcome network = simulate(scene);
  ASSERT_TRUE(network.result.completed) << network.result.stop_reason;
  ASSERT_EQ(network.path.steps.size(), built_in.path.steps.size());
  for (std::size_t k = 0; k < network.path.steps.size(); ++k) {
    const HeartState &a = network.path.steps[k], &b = built_in.path.steps[k];
    EXPECT_NEAR(a.volumes_mm3[0] / b.volumes_mm3[0], 1, 1e-8);
    EXPECT_NEAR(a.pressures_kPa[0], b.pressures_kPa[0], 1e-7);
    EXPECT_NEAR(a.vessels_kPa[0], b.vessels_kPa[0], 1e-7);
  }
  const Haemodynamics &a = *lv(network).haemodynamics, &b = *lv(built_in).haemodynamics;
  EXPECT_NEAR(a.stroke_work_mJ, b.stroke_work_mJ, 1e-6 * b.stroke_work_mJ);
  EXPECT_NEAR(a.cardiac_output_L_per_min, b.cardiac_output_L_per_min, 1e-6);
  EXPECT_EQ(a.valves[1].name, "aortic_valve");
  EXPECT_EQ(column(network, "aorta_mmHg").size(), column(built_in, "aorta_mmHg").size());
}

TEST(NetworkBeat, InTheClosedLoopOf2022KeepsItsBlood) {
  Scene scene = beating();
  scene.circulation->loop = scene::Loop::closed_2022;
  scene.time.max_beats = 3;
  const Outcome outcome = simulate(scene);
  ASSERT_TRUE(outcome.result.completed) << outcome.result.stop_reason;
  EXPECT_GT(lv(outcome).ef_percent, 30);
  EXPECT_LT(lv(outcome).ef_percent, 75);
  const auto model = circulation_model(false, scene);
  const auto blood = [&](const CirculationSample& s) {
    const auto [pressures, volumes, flows] = model->kinds();
    return s.states[0] + model->compliances().dot(s.states) + s.states.segment(1 + pressures, volumes).sum();
  };
  const auto& samples = outcome.path.circulation;
  EXPECT_NEAR(blood(samples.back()) / blood(samples.front()), 1, 2e-4);  // tolerance of the integration
  const auto start = circulation_start(false, scene);
  EXPECT_GT(blood(samples.front()), 500 * mm3_per_mL);
  EXPECT_EQ(start.states.size(), 11);
  const std::vector<double> atrium = column(outcome, "left_atrium_mL");
  EXPECT_GT(*std::ranges::max_element(atrium) - *std::ranges::min_element(atrium), 10);
  EXPECT_EQ(column(outcome, "venous_return_mL_per_s").size(), samples.size());
  EXPECT_EQ(outcome.result.balances.size(), 4U);
}

TEST(NetworkBeat, InTheClosedLoopOf2022ComesToItsLimit) {
  Scene scene = beating();
  scene.circulation->loop = scene::Loop::closed_2022;
  const Outcome outcome = simulate(scene);
  ASSERT_TRUE(outcome.result.completed) << outcome.result.stop_reason;
  EXPECT_LT(outcome.path.beats, scene.time.max_beats);
  for (const std::string& warning : outcome.result.warnings)
    EXPECT_EQ(warning.find("did not close"), std::string::npos) << warning;
  // What flows into the ventricle flows through every vessel.
  const double output = lv(outcome).haemodynamics->cardiac_output_L_per_min * 1000 / 60;
  EXPECT_GT(output, 50);
  for (const FlowBalance& b : outcome.result.balances) {
    EXPECT_NEAR(b.mean_outflow_mL_per_s, output, 0.03 * output) << b.name;
    EXPECT_NEAR(b.error_percent, 0, 2) << b.name;
  }
}

TEST(NetworkBeat, ALeakOfTheMitralValveComesBack) {
  Scene scene = beating();
  scene.circulation->mitral_leak_resistance_kPa_ms_per_mm3 = 1.5 * resistance_per_mmHg_s_per_mL;
  scene.time.max_beats = 2;
  const Outcome outcome = simulate(scene);
  ASSERT_TRUE(outcome.result.completed) << outcome.result.stop_reason;
  const ValveVolumes& mitral = lv(outcome).haemodynamics->valves[0];
  // Systole of some 0.35 s at some 80 mmHg above the atrium.
  EXPECT_GT(mitral.regurgitant_mL, 8);
  EXPECT_LT(mitral.regurgitant_mL, 35);
  EXPECT_NEAR(mitral.regurgitant_percent, 100 * mitral.regurgitant_mL / mitral.forward_mL, 1e-9);
}

TEST(NetworkBeat, AStenosisOfTheAorticValveHasItsGradient) {
  Scene scene = beating();
  scene.time.max_beats = 2;
  const double healthy = lv(simulate(scene)).haemodynamics->valves[1].mean_gradient_mmHg;
  // 0.8 cm²
  scene.circulation->aortic_stenosis_kPa_ms2_per_mm6 = 6.25e-4 * stenosis_per_mmHg_s2_per_mL2;
  const Outcome outcome = simulate(scene);
  const ValveVolumes& aortic = lv(outcome).haemodynamics->valves[1];
  EXPECT_LT(healthy, 5);
  EXPECT_GT(aortic.mean_gradient_mmHg, 15);
  EXPECT_GT(aortic.peak_gradient_mmHg, aortic.mean_gradient_mmHg);
  const std::vector<double> flow = column(outcome, "aortic_valve_mL_per_s"),
                            p = column(outcome, "left_ventricle_mmHg"),
                            artery = column(outcome, "aorta_mmHg");
  const auto top = static_cast<std::size_t>(std::ranges::max_element(flow) - flow.begin());
  EXPECT_NEAR(p[top] - artery[top], 0.007 * flow[top] + 6.25e-4 * flow[top] * flow[top], 0.02);
}

// By hand, from the columns of the table.
TEST(NetworkBeat, HaemodynamicsObeyTheirDefinitions) {
  Scene scene = beating();
  scene.time.max_beats = 4;
  const Outcome outcome = simulate(scene);
  const Haemodynamics& h = *lv(outcome).haemodynamics;
  const double es_mmHg = h.arterial_elastance_mmHg_per_mL * lv(outcome).sv_mL;
  EXPECT_GT(es_mmHg, 60);
  EXPECT_LT(es_mmHg, 130);
  EXPECT_NEAR(h.pressure_volume_area_mmHg_mL - h.stroke_work_mmHg_mL, 0.5 * es_mmHg * lv(outcome).esv_mL,
              0.02 * h.stroke_work_mmHg_mL);
  EXPECT_NEAR(h.pressure_volume_area_mJ / h.pressure_volume_area_mmHg_mL, kPa_per_mmHg, 1e-9);
  ASSERT_EQ(outcome.result.balances.size(), 1U);
  const FlowBalance& balance = outcome.result.balances[0];
  EXPECT_EQ(balance.name, "systemic_arteries");
  EXPECT_NEAR(balance.mean_outflow_mL_per_s, (h.arterial_mean_mmHg - 5) / (1.0 + 0.04), 1.0);
  EXPECT_NEAR(balance.error_percent, 0, 2);
  EXPECT_NEAR(balance.error_percent, 100 * (1 - balance.mean_outflow_mL_per_s / balance.mean_inflow_mL_per_s),
              1e-9);
}

TEST(NetworkBeat, AHeartThatTheNetworkDoesNotHoldIsRefused) {
  Scene scene = beating();
  CirculationNetwork wrong = network_of(left_heart_loop(*scene.circulation), 10);
  wrong.compartments[1].cavity = CavityName::rv;
  scene.circulation->network = std::make_shared<const CirculationNetwork>(wrong);
  EXPECT_THROW(simulate(scene), polyaffine::InputError);
}

}  // namespace
}  // namespace cardiac
