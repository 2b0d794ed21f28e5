#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include <cardiac/core/csv_reader.hpp>
#include <cardiac/report/summary.hpp>
#include <cardiac/report/tables.hpp>
#include <polyaffine/core/error.hpp>
#include "cardiac/report/synthetic_result.hpp"

namespace cardiac {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

long lines(const std::string& text) {
  return std::ranges::count(text, '\n');
}

std::vector<std::string> fields_of_line(const std::string& text, int line) {
  std::istringstream stream(text);
  std::string row, field;
  for (int i = 0; i < line; ++i) std::getline(stream, row);
  std::istringstream row_stream(row);
  std::vector<std::string> fields;
  while (std::getline(row_stream, field, ',')) fields.push_back(field);
  return fields;
}

TEST(Tables, HaveTheHeadersAndRowsOfTheInterface) {
  const BeatResult r = test::synthetic_beat();
  const std::string strain = strain_table(r), affine = affine_table(r), cavity = cavity_table(r);
  EXPECT_THAT(strain, StartsWith("time_ms,segment,name,longitudinal,circumferential,radial,shear_lc,shear_lr,"
                                 "shear_cr,volume_ratio\n0,1,basal anterior,0,0,0,0,0,0,1\n"));
  EXPECT_EQ(lines(strain), 1 + 81 * 17);
  EXPECT_THAT(affine,
              StartsWith("time_ms,segment,name,a_11,a_12,a_13,a_21,a_22,a_23,a_31,a_32,a_33,t_1_mm,"
                         "t_2_mm,t_3_mm,rotation_deg,stretch_1,stretch_2,stretch_3,determinant,misfit\n"));
  EXPECT_EQ(lines(affine), 1 + 81 * 17);
  EXPECT_THAT(cavity, StartsWith("time_ms,ventricle,volume_mL,pressure_mmHg,phase\n"
                                 "0,lv,121.4,8.3,isovolumetric_contraction\n"));
  EXPECT_EQ(lines(cavity), 1 + 161);
  for (const char* phase : {",filling\n", ",ejection\n", ",isovolumetric_relaxation\n"})
    EXPECT_THAT(cavity, HasSubstr(phase));
  BeatResult loading = r;
  loading.has_beat = false;
  EXPECT_THAT(cavity_table(loading), HasSubstr("\n0,lv,121.4,8.3,\n"));  // without a beat no phases
  EXPECT_EQ(lines(peaks_table(r)), 1 + 17);
  EXPECT_THAT(peaks_table(r), StartsWith("segment,name,peak_longitudinal,peak_longitudinal_time_ms,"));
}

TEST(Tables, PolarDecompositionGivesBackRotationAndStretches) {
  BeatResult r;
  r.segments = {{1, "a", 1, {}}};
  const polyaffine::Vec3 axis = polyaffine::Vec3(1, -2, 0.5).normalized();
  const polyaffine::Mat3 R = Eigen::AngleAxisd(0.7, axis).toRotationMatrix();
  const polyaffine::Mat3 Q =
      Eigen::AngleAxisd(-1.1, polyaffine::Vec3(3, 1, 2).normalized()).toRotationMatrix();
  const polyaffine::Mat3 U = Q * polyaffine::Vec3(0.8, 1.5, 1.1).asDiagonal() * Q.transpose();
  const polyaffine::Mat3 inverted = polyaffine::Vec3(1, 1, -0.5).asDiagonal();
  r.instants.resize(3);
  for (int k = 0; k < 3; ++k) r.instants[k].time_ms = k;
  r.instants[0].frames = {{R * U, {1, 2, 3}, 0.25}};
  r.instants[1].frames = {{inverted, {0, 0, 0}, 0}};
  r.instants[2].frames = {SegmentFrame{}};
  const std::string table = affine_table(r);
  const std::vector<std::string> row = fields_of_line(table, 2);
  ASSERT_EQ(row.size(), 21);
  // Nine significant digits are written.
  EXPECT_NEAR(std::stod(row[3]), (R * U)(0, 0), 1e-8);
  EXPECT_NEAR(std::stod(row[4]), (R * U)(0, 1), 1e-8);
  EXPECT_EQ(row[14], "3");
  EXPECT_NEAR(std::stod(row[15]), 0.7 * 180 / polyaffine::kPi, 1e-6);
  EXPECT_NEAR(std::stod(row[16]), 1.5, 1e-8);
  EXPECT_NEAR(std::stod(row[17]), 1.1, 1e-8);
  EXPECT_NEAR(std::stod(row[18]), 0.8, 1e-8);
  EXPECT_NEAR(std::stod(row[19]), 0.8 * 1.5 * 1.1, 1e-8);
  EXPECT_EQ(row[20], "0.25");
  EXPECT_EQ(fields_of_line(table, 3)[19], "-0.5");
  EXPECT_EQ(fields_of_line(table, 3)[18], "-0.5");
  EXPECT_EQ(fields_of_line(table, 3)[15], "0");
  EXPECT_EQ(fields_of_line(table, 4)[15], "0");
}

TEST(Tables, GlobalStrainHasARowATimeAndVentricle) {
  BeatResult r = test::synthetic_beat();
  const std::string table = global_strain_table(r);
  EXPECT_THAT(table, StartsWith("time_ms,ventricle,mean_longitudinal_percent,mean_circumferential_percent,"
                                "mean_radial_percent,twist_deg,endocardial_longitudinal_percent,"
                                "midwall_longitudinal_percent,epicardial_longitudinal_percent,"
                                "endocardial_circumferential_percent,midwall_circumferential_percent,"
                                "epicardial_circumferential_percent,wall_thickening_percent,"
                                "base_excursion_mm,apex_motion_mm\n0,lv,0,"));
  EXPECT_EQ(lines(table), 1 + 81);
  r.ventricles.push_back(r.ventricles[0]);
  r.ventricles[1].name = "rv";
  for (Instant& instant : r.instants) instant.global.push_back(instant.global[0]);
  r.instants[3].global[1].twist_deg = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(lines(global_strain_table(r)), 1 + 162);
  const std::vector<std::string> row = fields_of_line(global_strain_table(r), 9);
  EXPECT_EQ(row[1], "rv");
  EXPECT_EQ(row[5], "");
  EXPECT_NEAR(std::stod(row[6]), r.instants[3].global[1].longitudinal.endocardial_percent, 1e-6);
}

TEST(Tables, FramesAreWrittenWithAllDigits) {
  BeatResult r = test::synthetic_beat();
  r.frame_functions = {{"basal anterior", "1", true}, {"cap, \"x\"", "ltt", false}};
  for (Instant& instant : r.instants) instant.frame_unknowns = {{1.0 / 3, 0, -2}, {4, 5, 1e-300}};
  const std::string table = frames_table(r);
  EXPECT_THAT(table, StartsWith("time_ms,frame,axes,function,c_1_mm,c_2_mm,c_3_mm\n"
                                "0,basal anterior,local,1,0.3333333333333333,0,-2\n"
                                "0,\"cap, \"\"x\"\"\",cartesian,ltt,4,5,1e-300\n"));
  EXPECT_EQ(lines(table), 1 + 2 * 81);
}

TEST(Tables, MechanicsHaveARowPerTimeAndSegment) {
  BeatResult r = test::synthetic_beat();
  for (Instant& instant : r.instants)
    instant.mechanics.assign(17, {-0.125, 40.5, 80, std::nan(""), 60, 12.25, 13});
  const std::string table = mechanics_table(r);
  EXPECT_THAT(table, StartsWith("time_ms,segment,name,fibre_strain,fibre_stress_kPa,active_stress_kPa,"
                                "mean_stress_kPa,von_mises_kPa,work_mJ,active_work_mJ\n"
                                "0,1,basal anterior,-0.125,40.5,80,,60,12.25,13\n"));
  EXPECT_EQ(lines(table), 1 + 17 * 81);
}

TEST(Summary, TellsTheEnergyOfTheBeat) {
  BeatResult r = test::synthetic_beat();
  auto json = nlohmann::json::parse(summary_text(r, test::synthetic_info()));
  EXPECT_TRUE(json["energy_balance_percent"].is_null());
  r.energy = {1000, 900, 10, -5, 2, 60, 23};  // 10 mJ are missing
  json = nlohmann::json::parse(summary_text(r, test::synthetic_info()));
  EXPECT_NEAR(json["energy_balance_percent"].get<double>(), 1, 1e-9);
  EXPECT_NEAR(json["energy"]["residual_mJ"].get<double>(), 10, 1e-9);
  EXPECT_EQ(json["energy"]["viscosity_mJ"], 60);
  r.energy = {500, 1000, 0, 0, 0, 0, 0};  // the sign is in the residual
  json = nlohmann::json::parse(summary_text(r, test::synthetic_info()));
  EXPECT_NEAR(json["energy_balance_percent"].get<double>(), 50, 1e-9);
}

TEST(Tables, NamesWithCommasAndQuotesStayOneField) {
  BeatResult r = test::synthetic_beat();
  r.segments[0].name = "a \"b\", c";
  EXPECT_THAT(strain_table(r), HasSubstr("\n0,1,\"a \"\"b\"\", c\",0,0,"));
}

TEST(Tables, CardiacTimesAreTheLeftVentriclesOrTheEndsOfTheLoading) {
  BeatResult r = test::synthetic_beat();
  r.ventricles.insert(r.ventricles.begin(), VentricleSummary{"rv", 0, 0, 0, 0, 0, 0, 20, 300, {}});
  EXPECT_EQ(cardiac_times(r).es_ms, 330);
  r.has_beat = false;
  EXPECT_EQ(cardiac_times(r).es_ms, 800);
  EXPECT_EQ(cardiac_times(BeatResult{}).es_ms, 0);
}

TEST(Summary, HasEveryKeyOfTheInterface) {
  BeatResult r = test::synthetic_beat();
  r.verification = {{"ES", 330, 1.9, 1.1, 0.034, 14.8}};
  const auto json = nlohmann::json::parse(summary_text(r, test::synthetic_info()));
  EXPECT_EQ(json.at("program"), "cardiac");
  EXPECT_EQ(json.at("version"), "0.1.0");
  EXPECT_EQ(json.at("seed"), 7);
  EXPECT_EQ(json.at("protocol").at("time").at("rate_bpm"), 75);
  EXPECT_EQ(json.at("method"), "polyaffine");
  EXPECT_EQ(json.at("mesh").at("tets"), 6542);
  for (const char* key : {"dofs", "control_nodes", "integration_points", "beats", "time_steps",
                          "newton_iterations", "simulated_time_s", "min_det_F", "max_det_F"})
    EXPECT_TRUE(json.at(key).is_number()) << key;
  for (const char* key : {"setup", "solve", "output", "total"})
    EXPECT_TRUE(json.at("wall_time_s").at(key).is_number()) << key;
  EXPECT_EQ(json.at("timing").at("residuals"), 5400);
  EXPECT_EQ(json.at("timing").at("factorisations"), 610);
  EXPECT_EQ(json.at("timing").at("linear_solves"), 5210);
  double seconds = 0;
  for (const char* key :
       {"filling_s", "residual_s", "tangent_s", "factorisation_s", "linear_solve_s", "rest_s"})
    seconds += json.at("timing").at(key).get<double>();
  EXPECT_NEAR(seconds, r.wall_solve_s, 1e-8);
  EXPECT_NEAR(json.at("real_time_factor").get<double>(), 3.127 / 4, 1e-9);  // nine digits
  const auto& lv = json.at("ventricles").at("lv");
  EXPECT_EQ(lv.at("edv_mL"), 121.4);
  EXPECT_EQ(lv.at("ef_percent"), 58.65);
  for (const char* key : {"esv_mL", "sv_mL", "peak_pressure_mmHg", "edp_mmHg"})
    EXPECT_TRUE(lv.at(key).is_number()) << key;
  EXPECT_EQ(json.at("strain").at("gls_percent"), -18.42);
  for (const char* key : {"gcs_percent", "grs_percent", "twist_deg"})
    EXPECT_TRUE(json.at("strain").at(key).is_number()) << key;
  EXPECT_EQ(json.at("verification").at(0).at("max_segment_strain_error"), 0.034);
  EXPECT_EQ(json.at("plan").at(2).at("built"), false);
  EXPECT_TRUE(json.at("warnings").empty());
  EXPECT_EQ(json.at("completed"), true);
}

TEST(Summary, WithoutCirculationHasTheVolumeReachedAndNullForABeat) {
  BeatResult r = test::synthetic_beat();
  r.has_beat = false;
  const auto json = nlohmann::json::parse(summary_text(r, test::synthetic_info()));
  const auto& lv = json.at("ventricles").at("lv");
  EXPECT_TRUE(lv.at("ef_percent").is_null());
  EXPECT_EQ(lv.at("volume_mL"), 121.4);
  EXPECT_EQ(lv.at("pressure_mmHg"), 8.3);
}

TEST(Tables, NeverShowWhatIsNotANumber) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  BeatResult r = test::synthetic_beat();
  r.strain = {none, none, INFINITY, -INFINITY, {none, none, none}, {INFINITY, none, none}, none, none};
  r.instants[3].global[0] = r.strain;
  r.instants[3].frames[3].misfit = none;
  r.simulated_time_s = 0;  // the real-time factor does not exist
  r.instants[3].strain[4].radial = none;
  for (Instant& instant : r.instants) instant.strain[5].longitudinal = none;
  r.instants[3].frames[4].A(1, 1) = none;
  r.ventricles[0].samples[2].pressure_mmHg = INFINITY;
  r.segments[2].activation_ms = none;
  const std::string summary = summary_text(r, test::synthetic_info());
  EXPECT_TRUE(nlohmann::json::parse(summary).at("strain").at("gls_percent").is_null());
  EXPECT_TRUE(nlohmann::json::parse(summary).at("real_time_factor").is_null());
  for (const std::string& text :
       {strain_table(r), peaks_table(r), affine_table(r), global_strain_table(r), cavity_table(r), summary}) {
    EXPECT_THAT(std::regex_replace(text, std::regex("determinant"), ""), Not(HasSubstr("nan")));
    EXPECT_THAT(text, Not(HasSubstr("NaN")));
    EXPECT_THAT(text, Not(HasSubstr("inf,")));
  }
}

TEST(Tables, OfARunThatStoppedAreWrittenWithTheReason) {
  const test::TemporaryFolder folder;
  BeatResult r;
  r.method = "fem";
  r.stop_reason = "no convergence at 3 ms";
  write_tables(r, test::synthetic_info(), folder.path() / "new");
  const auto json = nlohmann::json::parse(read_text(folder.path() / "new" / "summary.json"));
  EXPECT_EQ(json.at("completed"), false);
  EXPECT_EQ(json.at("stop_reason"), "no convergence at 3 ms");
  EXPECT_EQ(lines(read_text(folder.path() / "new" / "strain.csv")), 1);
}

TEST(Tables, AFailingWriteLeavesTheOldResultAlone) {
  const test::TemporaryFolder folder;
  write_tables(test::synthetic_beat(), test::synthetic_info(), folder.path());
  const std::string before = read_text(folder.path() / "strain.csv");
  RunInfo broken = test::synthetic_info();
  broken.protocol_json = "{not json";
  EXPECT_THROW(write_tables(test::synthetic_beat(true), broken, folder.path()), polyaffine::InputError);
  EXPECT_EQ(read_text(folder.path() / "strain.csv"), before);
}

}  // namespace
}  // namespace cardiac
