#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "program.hpp"

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A protocol on the small ventricle of Land et al. (cavity 2.5 mL), without pictures.
std::string land(const TemporaryFolder& folder, const std::string& tables) {
  const fs::path file = folder.path / "land.toml";
  std::ofstream(file) << "[mesh]\nfile = \"" PROJECT_DIR
                         "/meshes/land_ellipsoid_coarse.vtu\"\nlength_unit = \"mm\"\n[output]\nfigures = "
                         "false\nmesh_series = false\n"
                      << tables;
  return file.string();
}

int rows(const fs::path& table) {
  const std::string text = whole_file(table);
  return static_cast<int>(std::ranges::count(text, '\n')) - 1;
}

nlohmann::json check_failed(const ProgramRun& run, const fs::path& out) {
  EXPECT_EQ(run.status, 1) << run.err;
  auto summary = nlohmann::json::parse(whole_file(out / "summary.json"));
  EXPECT_EQ(summary.at("completed"), false);
  const std::string reason = summary.at("stop_reason");
  EXPECT_FALSE(reason.empty());
  EXPECT_THAT(run.err, HasSubstr(reason));
  EXPECT_THAT(run.err, HasSubstr(out.string()));
  EXPECT_TRUE(summary.at("simulated_time_s").is_number());
  EXPECT_TRUE(summary.at("min_det_F").is_number());
  int tables = 0;
  for (const auto& entry : fs::directory_iterator(out)) {
    if (entry.path().extension() != ".csv") continue;
    ++tables;
    EXPECT_FALSE(std::regex_search(whole_file(entry.path()), std::regex("(^|[,\\n])-?(nan|inf)")))
        << entry.path();
  }
  // strain, its peaks, affine, control nodes, global strain, cavity; of a beat that began circulation too
  EXPECT_EQ(tables, summary.at("has_beat") && summary.at("simulated_time_s") > 0 ? 7 : 6);
  return summary;
}

TEST(FailedRun, PressureThatASoftWallCannotBear) {
  const TemporaryFolder folder;
  const fs::path out = folder.path / "out";
  const auto run = run_program(
      "run " +
      land(folder, "[tissue]\nlaw = \"neo_hookean\"\nmu_kPa = 0.1\n[cavities]\npressure_mmHg = 300\n") +
      " --out " + out.string());
  const auto summary = check_failed(run, out);
  const auto& lv = summary.at("ventricles").at("lv");
  EXPECT_GT(lv.at("pressure_mmHg"), 0) << "what was reached is written";
  EXPECT_LT(lv.at("pressure_mmHg"), 300);
  EXPECT_GT(rows(out / "strain.csv"), 17) << "more than the unloaded state";
  EXPECT_EQ(rows(out / "strain.csv") % 17, 0);
}

const std::string kBeat =
    "[tissue]\nlaw = \"guccione\"\nC_kPa = 0.05\nbf = 8\nbt = 2\nbfs = 12\n[fibres]\n[activation]\nonset_ms "
    "= 10\n[contraction]\ncontractility_kPa = 2000\ncross_fibre_fraction = 0.4\n[circulation]\n[time]\n"
    "max_beats = 1\n";

/// Runs kBeat with settings (--set).
auto run_beat(const TemporaryFolder& folder, const fs::path& out, const std::vector<std::string>& settings) {
  std::string command = "run " + land(folder, kBeat) + " --out " + out.string();
  for (const std::string& setting : settings) command += " --set " + setting;
  return run_program(command);
}

TEST(FailedRun, TolerancesBelowTheRoundingOfTheArithmetic) {
  const TemporaryFolder folder;
  const fs::path out = folder.path / "out";
  const auto run = run_beat(folder, out,
                            {"time.relative_tolerance=1e-10", "time.absolute_tolerance_mm=1e-10",
                             "time.absolute_tolerance_mmHg=1e-10"});
  const auto summary = check_failed(run, out);
  EXPECT_THAT(std::string(summary.at("stop_reason")), HasSubstr("(beat 1)"));
  EXPECT_LT(summary.at("simulated_time_s"), 0.8) << "the beat did not end";
  EXPECT_GE(rows(out / "cavity.csv"), 1);
}

// One pressure a segment leaves volumes within it to the local bulk modulus; the default keeps them at 400
// kPa.
TEST(FailedRun, CrushedWallIsWarnedOf) {
  const TemporaryFolder folder;
  const fs::path out = folder.path / "out";
  const auto run_with = [&](const std::string& local_kPa) {
    return run_beat(folder, out,
                    {"contraction.contractility_kPa=400", "reduction.pressure_space=segment",
                     "reduction.local_bulk_modulus_kPa=" + local_kPa});
  };
  const auto run = run_with("16");  // to 42 %
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("cardiac: warning: the wall was compressed to "));
  EXPECT_THAT(whole_file(out / "summary.json"), HasSubstr("the wall was compressed to "));
  // Below a tenth of its volume it is no result.
  const auto crushed = run_with("4");  // turned inside out
  EXPECT_THAT(std::string(check_failed(crushed, out).at("stop_reason")),
              HasSubstr("absurd result: the wall"));
  EXPECT_THAT(crushed.err, HasSubstr("cardiac: warning: the wall was compressed to "));
}

TEST(FailedRun, FillingThatDoesNotSucceed) {
  const TemporaryFolder folder;
  const fs::path out = folder.path / "out";
  const auto run = run_beat(folder, out,
                            {"circulation.filling_pressure_mmHg=100", "tissue.C_kPa=0.001",
                             "tissue.bulk_modulus_kPa=1", "reduction.local_bulk_modulus_kPa=0.5"});
  const auto summary = check_failed(run, out);
  EXPECT_THAT(std::string(summary.at("stop_reason")), HasSubstr("of 100"));
  EXPECT_EQ(summary.at("simulated_time_s"), 0);
}

}  // namespace
