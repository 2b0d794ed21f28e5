#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include <cardiac/report/haemodynamics_text.hpp>
#include <cardiac/report/summary.hpp>
#include <cardiac/report/summary_reader.hpp>
#include <cardiac/report/tables.hpp>
#include <polyaffine/core/error.hpp>
#include "cardiac/report/synthetic_result.hpp"

namespace cardiac {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

BeatResult beat_with_a_leak() {
  BeatResult r = test::synthetic_beat();
  VentricleSummary& lv = r.ventricles[0];
  lv.ed_is = "onset of contraction";
  lv.es_is = "closing of the outlet valve";
  lv.isovolumetric_relaxation_change_mL = 9.25;
  lv.haemodynamics = {.cardiac_output_L_per_min = 5.25,
                      .stroke_work_mmHg_mL = 7500,
                      .stroke_work_mJ = 999.9,
                      .dp_dt_max_mmHg_per_s = 1500,
                      .dp_dt_min_mmHg_per_s = -1400,
                      .arterial_mean_mmHg = 90,
                      .arterial_systolic_mmHg = 120,
                      .arterial_diastolic_mmHg = 60,
                      .venous_mean_mmHg = 10,
                      .valves = {{"mitral_valve", 70, 0, 0}, {"aortic_valve", 80, 40, 50}}};
  return r;
}

TEST(Haemodynamics, OfTheSummaryAreReadBack) {
  const std::string text = summary_text(beat_with_a_leak(), test::synthetic_info());
  const auto json = nlohmann::json::parse(text).at("haemodynamics").at("lv");
  EXPECT_EQ(json.at("cardiac_output_L_per_min"), 5.25);
  EXPECT_EQ(json.at("valves").at("aortic_valve").at("regurgitant_mL"), 40);
  const VentricleSummary lv = parse_summary(text, "summary.json").result.ventricles.at(0);
  EXPECT_EQ(lv.ed_is, "onset of contraction");
  EXPECT_EQ(lv.es_is, "closing of the outlet valve");
  EXPECT_EQ(lv.isovolumetric_relaxation_change_mL, 9.25);
  ASSERT_TRUE(lv.haemodynamics);
  EXPECT_EQ(lv.haemodynamics->stroke_work_mJ, 999.9);
  EXPECT_EQ(lv.haemodynamics->dp_dt_min_mmHg_per_s, -1400);
  EXPECT_EQ(lv.haemodynamics->arterial_diastolic_mmHg, 60);
  ASSERT_EQ(lv.haemodynamics->valves.size(), 2U);
  EXPECT_EQ(lv.haemodynamics->valves[1].name, "aortic_valve");
  EXPECT_EQ(lv.haemodynamics->valves[1].regurgitant_percent, 50);

  std::string other = text;
  other.replace(other.rfind("\"lv\": {", other.find("cardiac_output")), 4, "\"la\"");
  EXPECT_THROW(parse_summary(other, "summary.json"), polyaffine::InputError);
}

TEST(Haemodynamics, AreToldInWordsAndALeakOnlyWhereThereIsOne) {
  BeatResult r = beat_with_a_leak();
  EXPECT_THAT(haemodynamics_lines(r.ventricles[0]),
              ElementsAre(::testing::AllOf(HasSubstr("5.2 L/min"), HasSubstr("aorta 120/60 mmHg, mean 90"),
                                           HasSubstr("1000 mJ")),
                          HasSubstr("aortic valve: 40.0 mL of 80.0 mL come back (50 %)"),
                          HasSubstr("9.2 mL in isovolumetric relaxation")));
  r.ventricles[0].haemodynamics->valves[1].regurgitant_mL = 0.5;
  r.ventricles[0].isovolumetric_relaxation_change_mL = 0.2;
  EXPECT_EQ(haemodynamics_lines(r.ventricles[0]).size(), 1U);
  EXPECT_TRUE(haemodynamics_lines(test::synthetic_beat().ventricles[0]).empty());
}

TEST(Haemodynamics, GradientsAndWorkAreToldAndReadBack) {
  BeatResult r = beat_with_a_leak();
  Haemodynamics& h = *r.ventricles[0].haemodynamics;
  h.valves[1].mean_gradient_mmHg = 31.4;
  h.valves[1].peak_gradient_mmHg = 52;
  h.valves[0].mean_gradient_mmHg = 1.5;
  h.pressure_volume_area_mJ = 1294;
  h.pressure_volume_area_mmHg_mL = 9702;
  h.arterial_elastance_mmHg_per_mL = 1.523;
  r.balances = {{"systemic_arteries", 85, 84.9, 0.118}, {"lungs", 80, 60, 25}};
  const auto lines = haemodynamics_lines(r.ventricles[0]);
  EXPECT_EQ(lines.at(1), "pressure-volume area 1294 mJ, arterial elastance 1.52 mmHg/mL");
  EXPECT_EQ(lines.at(2), "aortic valve: gradient 31 mmHg in the mean, 52 mmHg at most");
  EXPECT_THAT(balance_lines(r), ElementsAre(HasSubstr("lungs: 80.0 mL/s flow in, 60.0 mL/s out (25.0 %)")));
  const auto back = parse_summary(summary_text(r, test::synthetic_info()), "summary.json").result;
  const Haemodynamics& read = *back.ventricles[0].haemodynamics;
  EXPECT_EQ(read.pressure_volume_area_mJ, 1294);
  EXPECT_EQ(read.pressure_volume_area_mmHg_mL, 9702);
  EXPECT_EQ(read.arterial_elastance_mmHg_per_mL, 1.523);
  EXPECT_EQ(read.valves[1].mean_gradient_mmHg, 31.4);
  EXPECT_EQ(read.valves[1].peak_gradient_mmHg, 52);
  ASSERT_EQ(back.balances.size(), 2U);
  const auto lungs = std::ranges::find(back.balances, "lungs", &FlowBalance::name);
  ASSERT_NE(lungs, back.balances.end());
  EXPECT_EQ(lungs->mean_outflow_mL_per_s, 60);
}

TEST(Haemodynamics, TableHasAColumnEachAndNoWordsForWhatIsNotANumber) {
  BeatResult r;
  r.circulation = {{"time_ms", "aorta_mmHg"}, {{0, 2.5}, {80, std::numeric_limits<double>::quiet_NaN()}}};
  EXPECT_EQ(circulation_text(r), "time_ms,aorta_mmHg\n0,80\n2.5,\n");
}

}  // namespace
}  // namespace cardiac
