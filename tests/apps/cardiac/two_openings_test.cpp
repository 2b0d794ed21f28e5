#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <polyaffine/mesh/surface.hpp>

#include "program.hpp"
#include "support/mesh_writers.hpp"
#include "support/odd_walls.hpp"

namespace {

using testing::HasSubstr;

/// From the file of another tool to a beat, with a mitral and an aortic opening.
TEST(TwoOpenings, AreImportedDividedAndBeat) {
  const TemporaryFolder folder;
  const std::string msh = (folder.path / "two.msh").string(), vtu = (folder.path / "two.vtu").string();
  testing_io::write_gmsh_4(msh, testing_io::data_of(cardiac::odd_walls::two_openings()), true);
  const ProgramRun import = run_program("mesh import " + msh + " --length-unit mm --out " + vtu);
  ASSERT_EQ(import.status, 0) << import.err;
  EXPECT_THAT(import.out, HasSubstr("free of stress"));
  const ProgramRun segment = run_program("segment " + vtu + " --scheme aha17 --length-unit mm --out " +
                                         (folder.path / "segments.vtu").string());
  ASSERT_EQ(segment.status, 0) << segment.err;
  EXPECT_THAT(segment.out, HasSubstr("2 openings of the left cavity"));
  EXPECT_THAT(segment.err, HasSubstr("anterior is taken as +y"));

  const auto out = folder.path / "beat";
  const ProgramRun run =
      run_program("run " PROJECT_DIR "/protocols/healthy_lv.toml --set mesh.file='\"" + vtu +
                  "\"' --set output.mesh_series=false --set output.figures=false "
                  "--set time.max_beats=2 --out " +
                  out.string());
  ASSERT_EQ(run.status, 0) << run.err;
  const auto lv = nlohmann::json::parse(whole_file(out / "summary.json"))["ventricles"]["lv"];
  const double cavity_mL = polyaffine::EnclosedVolume(cardiac::odd_walls::two_openings(), {1})
                               .value(cardiac::odd_walls::two_openings().points()) /
                           1000;
  EXPECT_GT(lv["edv_mL"].get<double>(), cavity_mL) << "filled";
  EXPECT_LT(lv["edv_mL"].get<double>(), 2 * cavity_mL);
  EXPECT_GT(lv["ef_percent"].get<double>(), 40) << "58 is reached";
  EXPECT_LT(lv["ef_percent"].get<double>(), 75);
}

}  // namespace
