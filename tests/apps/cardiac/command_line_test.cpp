#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "program.hpp"

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

namespace {

/// A protocol that needs no mesh file.
std::string shape_protocol(const TemporaryFolder& folder) {
  const auto file = folder.path / "passive.toml";
  std::ofstream(file) << "[mesh]\nshape = \"human_lv\"\n[tissue]\nlaw = \"neo_hookean\"\n[cavities]\n"
                         "pressure_mmHg = 7.5\n";
  return file.string();
}

TEST(CommandLine, HelpAndVersion) {
  for (const char* arguments : {"--help", "run --help", "schema --help", "explain --help"}) {
    const auto run = run_program(arguments);
    EXPECT_EQ(run.status, 0) << arguments;
    EXPECT_THAT(run.out, HasSubstr("--help"));
    EXPECT_THAT(run.err, IsEmpty());
  }
  const auto version = run_program("--version");
  EXPECT_EQ(version.status, 0);
  EXPECT_THAT(version.out, StartsWith("cardiac "));
}

TEST(CommandLine, WrongUsageIsStatusTwo) {
  for (const char* arguments :
       {"", "dance", "run", "run --no-such-option x.toml", "explain no.key", "schema extra",
        "run x.toml --method magic", "run x.toml --quiet --verbose"}) {
    const auto run = run_program(arguments);
    EXPECT_EQ(run.status, 2) << arguments;
    EXPECT_THAT(run.err, StartsWith("cardiac: error: ")) << arguments;
    EXPECT_THAT(run.out, IsEmpty());
  }
}

TEST(CommandLine, SchemaIsJson) {
  const auto run = run_program("schema");
  EXPECT_EQ(run.status, 0);
  const auto schema = nlohmann::json::parse(run.out);
  EXPECT_EQ(schema.at("additionalProperties"), false);
  EXPECT_TRUE(schema.at("properties").at("mesh").at("properties").contains("length_unit"));
}

TEST(CommandLine, ExplainKeyTableAndNearest) {
  const auto key = run_program("explain time.heart_rate_bpm");
  EXPECT_EQ(key.status, 0);
  EXPECT_THAT(key.out, AllOf(HasSubstr("1/min"), HasSubstr("default   75"), HasSubstr("at least 20")));
  const auto table = run_program("explain fibres");
  EXPECT_EQ(table.status, 0);
  EXPECT_THAT(table.out, HasSubstr("endo_angle_deg"));
  const auto unknown = run_program("explain time.heart_rate_bmp");
  EXPECT_EQ(unknown.status, 2);
  EXPECT_THAT(unknown.err, AllOf(StartsWith("cardiac: error: "), HasSubstr("time.heart_rate_bpm")));
  EXPECT_THAT(unknown.out, IsEmpty());
}

TEST(CommandLine, DryRunPrintsThePlanAndWritesNothing) {
  const TemporaryFolder folder;
  const std::string out = (folder.path / "out").string();
  const auto run = run_program("run " + shape_protocol(folder) + " --dry-run --out " + out);
  EXPECT_EQ(run.status, 0) << run.err;
  for (const char* part : {"fibres", "activation", "contraction", "circulation"}) {
    EXPECT_THAT(run.out, testing::ContainsRegex(std::string("\n") + part + " +left out  ")) << part;
  }
  EXPECT_THAT(run.out, testing::ContainsRegex("\nreduction +built "));
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST(CommandLine, OptionsReachThePlan) {
  const TemporaryFolder folder;
  const auto file = shape_protocol(folder);
  const auto fem = run_program("run --dry-run --method fem --set output.figures=false " + file);
  EXPECT_EQ(fem.status, 0) << fem.err;
  EXPECT_THAT(fem.out, testing::ContainsRegex("\nreduction +left out"));
  EXPECT_THAT(fem.out, testing::ContainsRegex("\nfigures +left out"));
  const auto verified = run_program("run --dry-run --verify " + file);
  EXPECT_THAT(verified.out, testing::ContainsRegex("\nverification +built"));
  const auto region =
      run_program("run --dry-run " + file + " --set 'region=[{segments=[1, 2]}]' --set time.load_steps=3");
  EXPECT_EQ(region.status, 0) << region.err;
  EXPECT_THAT(region.out, testing::ContainsRegex("\nregions +built"));
}

TEST(CommandLine, VerboseTellsWhereTheTimeWent) {
  const TemporaryFolder folder;
  const auto run = run_program("run --verbose " PROJECT_DIR
                               "/protocols/healthy_lv.toml --set output.figures=false --set "
                               "output.mesh_series=false --set time.max_beats=1 --out " +
                               folder.path.string());
  EXPECT_EQ(run.status, 0) << run.err;
  for (const char* part : {"residuals", "tangents", "factorisations", "linear solves"})
    EXPECT_THAT(run.out, testing::ContainsRegex(std::string(part) + " +[0-9]+ +[0-9.]+ s")) << part;
}

TEST(CommandLine, WarningsGoToStderrInAnyCase) {
  const TemporaryFolder folder;
  const auto arguments = "run --dry-run --set tissue.C_kPa=2 " + shape_protocol(folder);
  const auto loud = run_program(arguments);
  EXPECT_EQ(loud.status, 0);
  EXPECT_THAT(loud.err, AllOf(StartsWith("cardiac: warning: "), HasSubstr("tissue.C_kPa")));
  EXPECT_EQ(run_program(arguments + " --quiet").err, loud.err);
}

TEST(CommandLine, WrongInputIsStatusTwoAndDamagesNothing) {
  const TemporaryFolder folder;
  const auto file = shape_protocol(folder);
  const auto kept = folder.path / "kept";
  std::filesystem::create_directory(kept);
  std::ofstream(kept / "summary.json") << "{}";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"nowhere.toml", "no such file"},
      {file + " --set tissue.mu_kPa=-1", "above 0, at most"},
      {file + " --set tissue.mu=1", "tissue.mu_kPa"},
      {file + " --set time.max_beats=many", "a whole number"},
      {file + " --set tissue", "expected key.path=value"},
      {file + " --set 'mesh={file=\"a.vtu\"}'", "expected one of the two"}};
  for (const auto& [arguments, expected] : cases) {
    const auto run = run_program("run " + arguments + " --out " + kept.string());
    EXPECT_EQ(run.status, 2) << arguments;
    EXPECT_THAT(run.err, AllOf(StartsWith("cardiac: error: "), HasSubstr(expected))) << arguments;
  }
  EXPECT_EQ(whole_file(kept / "summary.json"), "{}");

  const auto absent = folder.path / "absent.toml";
  std::ofstream(absent)
      << "[mesh]\nfile = \"none.vtu\"\nlength_unit = \"mm\"\n[tissue]\nlaw = \"neo_hookean\"\n"
         "[cavities]\npressure_mmHg = 1\n";
  const auto run = run_program("run --dry-run " + absent.string());
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, AllOf(HasSubstr("mesh.file"), HasSubstr("none.vtu")));
}

}  // namespace
