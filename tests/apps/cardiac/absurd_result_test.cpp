#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "program.hpp"

namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

std::string beat(const TemporaryFolder& folder, const std::string& unit) {
  const fs::path file = folder.path / "beat.toml";
  std::ofstream(file)
      << "[mesh]\nfile = \"" PROJECT_DIR "/meshes/land_ellipsoid_coarse.vtu\"\nlength_unit = \"" << unit
      << "\"\n[tissue]\n[fibres]\n[activation]\n[contraction]\n[circulation]\n[time]\nmax_beats "
         "= 1\n[output]\nfigures = false\nmesh_series = false\n";
  return file.string();
}

nlohmann::json summary(const fs::path& out) {
  return nlohmann::json::parse(whole_file(out / "summary.json"));
}

// An outlet that lets next to nothing through, and the strongest of muscles: a pressure that no heart bears.
const std::string kClosed =
    " --set circulation.aortic_valve_resistance_mmHg_s_per_mL=100 --set contraction.contractility_kPa=2000";

TEST(AbsurdResult, EndsWithStatusOneAndItsTablesUnlessForced) {
  const TemporaryFolder folder;
  const fs::path out = folder.path / "out";
  const std::string arguments = "run " + beat(folder, "mm") + " --out " + out.string() + kClosed;
  const auto run = run_program(arguments);
  EXPECT_EQ(run.status, 1) << run.err;
  EXPECT_THAT(run.err, AllOf(HasSubstr("absurd result: "), HasSubstr("peak pressure is"),
                             HasSubstr("expected at most 500 mmHg"), HasSubstr("--force")));
  EXPECT_EQ(summary(out).at("completed"), false);
  EXPECT_THAT(std::string(summary(out).at("stop_reason")), HasSubstr("absurd result: "));
  for (const char* table : {"strain.csv", "strain_peaks.csv", "affine.csv", "cavity.csv"})
    EXPECT_GT(fs::file_size(out / table), 200U) << table;

  const auto forced = run_program(arguments + " --force");
  EXPECT_EQ(forced.status, 0) << forced.err;
  EXPECT_THAT(forced.err, AllOf(HasSubstr("warning: absurd result"), HasSubstr("peak pressure is")));
  EXPECT_EQ(summary(out).at("completed"), true);
}

TEST(AbsurdResult, AWrongLengthUnitIsRefusedBeforeAnythingIsComputed) {
  const TemporaryFolder folder;
  const fs::path out = folder.path / "out";
  for (const char* dry : {"", " --dry-run"}) {
    const auto run = run_program("run " + beat(folder, "m") + " --out " + out.string() + dry);
    EXPECT_EQ(run.status, 2);
    EXPECT_THAT(run.err, AllOf(HasSubstr("land_ellipsoid_coarse.vtu: mesh.length_unit: the wall has "),
                               HasSubstr(" mL in m, expected 0.015 to 10000 mL"), HasSubstr(" mL in mm")));
    EXPECT_FALSE(fs::exists(out));
  }
  const auto forced = run_program("run " + beat(folder, "m") + " --dry-run --force --out " + out.string());
  EXPECT_EQ(forced.status, 0) << forced.err;
  EXPECT_THAT(forced.err, HasSubstr("warning: "));
  const auto segment = run_program("segment " PROJECT_DIR
                                   "/meshes/land_ellipsoid_coarse.vtu --scheme aha17 --length-unit m --out " +
                                   (folder.path / "segments.vtu").string());
  EXPECT_EQ(segment.status, 2);
  EXPECT_THAT(segment.err, HasSubstr("--length-unit: the wall has "));
}

// Neither protocol names the scheme: the mesh tells it.
TEST(Scheme, IsThatOfTheMesh) {
  const TemporaryFolder folder;
  const auto plan = [&](const std::string& mesh, const std::string& more) {
    return run_program("run " + beat(folder, "mm") + " --dry-run --set 'mesh.file=\"" PROJECT_DIR "/meshes/" +
                       mesh + "\"'" + more);
  };
  EXPECT_THAT(plan("healthy_biv_coarse.vtu", "").out, HasSubstr("(aha29)"));
  EXPECT_THAT(plan("land_ellipsoid_coarse.vtu", "").out, HasSubstr("(aha17)"));
  const auto right = plan("healthy_biv_coarse.vtu", " --set circulation.right_filling_pressure_mmHg=6");
  EXPECT_EQ(right.err.find("plays no part"), std::string::npos) << right.err;
  const auto named = plan("healthy_biv_coarse.vtu", " --set anatomy.scheme=aha17");
  EXPECT_EQ(named.status, 2);
  EXPECT_THAT(named.err, HasSubstr("anatomy.scheme: found aha17, but the mesh has two ventricles"));
}

}  // namespace
