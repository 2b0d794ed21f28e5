#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

// Land's small ventricle, taken as imaged.
const std::string kHeart =
    "\"" PROJECT_DIR "/protocols/passive_inflation.toml\" --set 'mesh.file=\"" PROJECT_DIR
    "/meshes/land_ellipsoid_coarse.vtu\"' --set output.mesh_series=false --set cavities.pressure_mmHg=5 ";
const std::string kImaged = kHeart + "--set mesh.pressure_mmHg=5 ";

nlohmann::json summary(const std::filesystem::path& out) {
  return nlohmann::json::parse(whole_file(out / "summary.json"));
}

// "lv: volume 3.2 mL at 5.0 mmHg"
double last_volume_mL(const ProgramRun& run) {
  const std::string before = "lv: volume ";
  const std::size_t at = run.out.find(before);
  return at == std::string::npos ? -1 : std::stod(run.out.substr(at + before.size()));
}

TEST(UnloadCommand, WritesAShapeThatRunsToTheImage) {
  const TemporaryFolder folder;
  const std::string mesh = (folder.path / "free.vtu").string();
  const auto by_itself = folder.path / "a", from_file = folder.path / "b";
  const ProgramRun unloaded = run_program("unload " + kImaged + "--out " + mesh);
  ASSERT_EQ(unloaded.status, 0) << unloaded.err;
  EXPECT_THAT(unloaded.out, AllOf(HasSubstr("imaged at 5.0 mmHg"), HasSubstr("inflations")));
  const ProgramRun run = run_program("run " + kImaged + "--out " + by_itself.string());
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("imaged at 5.0 mmHg"));
  const ProgramRun again =
      run_program("run " + kHeart + "--set 'mesh.file=\"" + mesh + "\"' --out " + from_file.string());
  ASSERT_EQ(again.status, 0) << again.err;
  const auto a = summary(by_itself), b = summary(from_file);
  ASSERT_TRUE(a.contains("unloading"));
  EXPECT_FALSE(b.contains("unloading"));
  EXPECT_LE(a["unloading"]["inflations"].get<int>(), 15);
  const double imaged_mL = a["unloading"]["cavities"]["lv"]["imaged_mL"];
  // Between the vertices of this coarse mesh, where the surface is curved anew, lies 1 % of the volume; one
  // digit is printed.
  EXPECT_NEAR(last_volume_mL(run), imaged_mL, 1e-2 * imaged_mL + 0.05);
  EXPECT_NEAR(last_volume_mL(again), last_volume_mL(run), 0.051);
  EXPECT_LT(a["unloading"]["cavities"]["lv"]["unloaded_mL"].get<double>(), 0.95 * imaged_mL);
  for (const char* file : {"filling.csv", "filling.svg"}) {
    EXPECT_TRUE(std::filesystem::exists(by_itself / file)) << file;
    EXPECT_FALSE(std::filesystem::exists(from_file / file)) << file;
  }
  ASSERT_EQ(run_program("report " + by_itself.string()).status, 0);
  EXPECT_THAT(whole_file(by_itself / "report.html"), HasSubstr("The unloaded heart"));
}

TEST(UnloadCommand, RefusesWrongInput) {
  const TemporaryFolder folder;
  const std::string out = "--out " + (folder.path / "free.vtu").string();
  const auto error = [&](const std::string& arguments) {
    const ProgramRun run = run_program(arguments);
    EXPECT_EQ(run.status, 2) << arguments;
    return run.err;
  };
  EXPECT_THAT(error("unload " + kHeart + out), HasSubstr("mesh.pressure_mmHg: missing"));
  EXPECT_THAT(error("unload " + kHeart + "--set mesh.pressure_mmHg=-5 " + out),
              AllOf(HasSubstr("mesh.pressure_mmHg"), HasSubstr("-5"), HasSubstr("mmHg")));
  EXPECT_THAT(error("unload " + kImaged + "--out " + (folder.path / "free.stl").string()), HasSubstr(".vtu"));
  EXPECT_EQ(run_program("unload " + kImaged).status, 2);  // no --out
  const ProgramRun right = run_program("run --dry-run " + kImaged + "--set mesh.right_pressure_mmHg=3");
  EXPECT_EQ(right.status, 0);
  EXPECT_THAT(right.err, HasSubstr("mesh.right_pressure_mmHg plays no part"));
  EXPECT_THAT(right.out, HasSubstr("unloading"));
  EXPECT_FALSE(std::filesystem::exists(folder.path / "free.vtu"));
}

TEST(UnloadCommand, LeavesEarlierResultsWhereThereIsNoStressFreeShape) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path / "out");
  std::ofstream(folder.path / "out" / "strain.csv") << "earlier\n";
  const ProgramRun run = run_program("run " + kImaged +
                                     "--set mesh.pressure_mmHg=60 --set tissue.law=neo_hookean --set "
                                     "tissue.mu_kPa=0.5 --out " +
                                     (folder.path / "out").string());
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.err, HasSubstr("mesh.pressure_mmHg: found 60 mmHg"));
  EXPECT_EQ(whole_file(folder.path / "out" / "strain.csv"), "earlier\n");
}

}  // namespace
