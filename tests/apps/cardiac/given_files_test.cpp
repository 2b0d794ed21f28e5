#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <polyaffine/vtk/read.hpp>
#include <sstream>

#include "program.hpp"

namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

const std::string kLand = PROJECT_DIR "/meshes/land_ellipsoid_coarse.vtu";

/// Columns of a table by their names; cells that are no numbers are zero.
std::map<std::string, std::vector<double>> columns(const fs::path& table) {
  std::istringstream text(whole_file(table));
  std::vector<std::string> names;
  std::map<std::string, std::vector<double>> out;
  std::string line, cell;
  for (bool header = true; std::getline(text, line); header = false) {
    std::istringstream row(line);
    for (std::size_t i = 0; std::getline(row, cell, ','); ++i)
      header ? names.push_back(cell) : out[names.at(i)].push_back(std::atof(cell.c_str()));
  }
  return out;
}

class GivenFiles : public testing::Test {
 protected:
  fs::path in(const std::string& name) const { return folder_.path / name; }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(in(name)) << text;
    return in(name).string();
  }
  /// A beat of Land's ellipsoid; a circulation or what is given comes behind.
  std::string protocol(const std::string& name, const std::string& more) const {
    return write(
        name, "[mesh]\nfile = \"" + kLand +
                  "\"\nlength_unit = \"mm\"\n[fibres]\n[activation]\n[contraction]\ncontractility_kPa = 60\n"
                  "[output]\nmesh_series = false\nfigures = false\ninterval_ms = 20\n" +
                  more);
  }

  TemporaryFolder folder_;
};

// The pressures that one run writes are what another follows.
TEST_F(GivenFiles, TheCavityTableOfARunDrivesAnother) {
  const std::string beat = protocol("beat.toml",
                                    "[circulation]\ninitial_aortic_pressure_mmHg = "
                                    "20\ncompliance_mL_per_mmHg = 0.4\n[time]\nmax_beats = 1\n");
  const ProgramRun first = run_program("run " + beat + " --force --out " + in("beat").string());
  ASSERT_EQ(first.status, 0) << first.err;
  const std::string follow =
      protocol("follow.toml", "[cavities]\npressure_file = \"beat/cavity.csv\"\nrepeats = \"no\"\n");
  const ProgramRun second = run_program("run " + follow + " --force --out " + in("follow").string());
  ASSERT_EQ(second.status, 0) << second.err;
  auto a = columns(in("beat/cavity.csv")), b = columns(in("follow/cavity.csv"));
  const auto [low, high] = std::ranges::minmax_element(a["volume_mL"]);
  EXPECT_GT(*high - *low, 2);  // the small ellipsoid, loaded as a human heart
  EXPECT_NEAR(*std::ranges::min_element(b["volume_mL"]), *low, 0.02 * (*high - *low));
  const ProgramRun third =
      run_program("run " + follow + " --set cavities.repeats=yes --set time.duration_ms=1600 --force --out " +
                  in("twice").string());
  ASSERT_EQ(third.status, 0) << third.err;
  EXPECT_NEAR(columns(in("twice/cavity.csv"))["time_ms"].back(), 1600, 1e-6);
}

TEST_F(GivenFiles, ActivationTimesComeFromAnArrayOfTheMesh) {
  ASSERT_EQ(
      run_program("segment " + kLand + " --scheme aha17 --length-unit mm --out " + in("heart.vtu").string())
          .status,
      0);
  const std::string beat = protocol("beat.toml", "[circulation]\n[time]\nmax_beats = 1\n");
  const std::string set =
      "run " + beat + " --set mesh.file=" + in("heart.vtu").string() + " --set activation.mode=array ";
  // Heights from 0 to 1, here as tenths of a second.
  const ProgramRun run = run_program(set +
                                     "--set activation.array_s=apicobasal --set output.mesh_series=true "
                                     "--set output.interval_ms=800 --force --out " +
                                     in("out").string());
  ASSERT_EQ(run.status, 0) << run.err;
  const auto mesh = polyaffine::read_mesh_file(in("heart.vtu"), 1, {.fields = true});
  std::vector<fs::path> series;
  for (const auto& entry : fs::directory_iterator(in("out")))
    if (entry.path().extension() == ".vtu") series.push_back(entry.path());
  ASSERT_FALSE(series.empty());
  const auto told = polyaffine::read_mesh_file(series.front(), 1, {.fields = true});
  const auto& given = mesh.point_fields.at("apicobasal");
  const auto& found = told.point_fields.at("activation_ms");
  ASSERT_EQ(given.cols(), found.cols());
  EXPECT_LT((1000 * given - found).cwiseAbs().maxCoeff(), 1e-2);  // written with single precision
  EXPECT_GT(found.maxCoeff(), 500);

  const ProgramRun wrong = run_program(set + "--set activation.array_ms=lat --dry-run");
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err,
              AllOf(HasSubstr("heart.vtu: found no point array \"lat\""), HasSubstr("apicobasal")));
}

TEST_F(GivenFiles, WrongTablesEndWithStatusTwo) {
  const std::string table = write("wrong.csv", "time_ms,pressure_mmHg\n0,5\n400,high\n800,5\n");
  const ProgramRun run =
      run_program("run " + protocol("p.toml", "[cavities]\npressure_file = \"wrong.csv\"\n") + " --dry-run");
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("wrong.csv:3, column 'pressure_mmHg': found 'high', expected a number"));
}

// A network of one's own, its names in the table, leaks and work in the summary.
TEST_F(GivenFiles, ANetworkIsToldByItsNames) {
  const std::string network = protocol(
      "network.toml",
      "[circulation]\nloop = \"network\"\n"
      "[[circulation.compartment]]\nname = \"atrium\"\ntype = \"pressure\"\npressure_mmHg = 10\n"
      "[[circulation.compartment]]\nname = \"chamber\"\ntype = \"ventricle\"\npressure_mmHg = 10\n"
      "[[circulation.compartment]]\nname = \"root\"\ntype = \"junction\"\n"
      "[[circulation.compartment]]\nname = \"aorta\"\ncompliance_mL_per_mmHg = 0.4\npressure_mmHg = 30\n"
      "[[circulation.compartment]]\nname = \"veins\"\ntype = \"pressure\"\npressure_mmHg = 5\n"
      "[[circulation.element]]\nname = \"inlet\"\ntype = \"valve\"\nfrom = \"atrium\"\nto = \"chamber\"\n"
      "resistance_mmHg_s_per_mL = 0.02\nleak_resistance_mmHg_s_per_mL = 4\n"
      "[[circulation.element]]\nname = \"outlet\"\ntype = \"valve\"\nfrom = \"chamber\"\nto = \"root\"\n"
      "resistance_mmHg_s_per_mL = 0.02\n"
      "[[circulation.element]]\nname = \"proximal\"\nfrom = \"root\"\nto = "
      "\"aorta\"\nresistance_mmHg_s_per_mL = 0.1\n"
      "[[circulation.element]]\nname = \"body\"\nfrom = \"aorta\"\nto = \"veins\"\nresistance_mmHg_s_per_mL "
      "= 3\n"
      "[time]\nmax_beats = 2\n");
  const ProgramRun run = run_program("run " + network + " --force --out " + in("out").string());
  ASSERT_EQ(run.status, 0) << run.err;
  auto table = columns(in("out/circulation.csv"));
  for (const char* name : {"time_ms", "atrium_mmHg", "chamber_mmHg", "chamber_mL", "root_mmHg", "aorta_mmHg",
                           "inlet_mL_per_s", "outlet_mL_per_s", "proximal_mL_per_s", "body_mL_per_s"})
    EXPECT_TRUE(table.contains(name)) << name;
  for (std::size_t i = 0; i < table["time_ms"].size(); ++i)
    EXPECT_NEAR(table["outlet_mL_per_s"][i], table["proximal_mL_per_s"][i],
                1e-5 * (1 + std::abs(table["outlet_mL_per_s"][i])));
  const auto summary = nlohmann::json::parse(whole_file(in("out/summary.json")));
  const auto& valves = summary.at("haemodynamics").at("lv").at("valves");
  EXPECT_GT(valves.at("inlet").at("regurgitant_mL"), 0.5);
  EXPECT_TRUE(valves.at("outlet").contains("mean_gradient_mmHg"));
  EXPECT_TRUE(summary.at("flow_balances").at("aorta").contains("error_percent"));
}

}  // namespace
