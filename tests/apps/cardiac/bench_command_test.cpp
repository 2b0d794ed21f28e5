#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "program.hpp"

using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

namespace {

std::vector<std::vector<std::string>> rows_of(const std::string& csv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream text(csv);
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("#")) continue;
    rows.emplace_back();
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');) rows.back().push_back(field);
    if (line.ends_with(',')) rows.back().emplace_back();
  }
  return rows;
}

TEST(BenchCommand, ComparesModelsOfOneScene) {
  const TemporaryFolder folder;
  const auto run = run_program("bench ellipsoid_passive --quick --out " + folder.path.string());
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("polyaffine"));
  EXPECT_THAT(whole_file(folder.path / "bench.svg"), StartsWith("<svg"));
  EXPECT_THAT(whole_file(folder.path / "bench.md"), HasSubstr("| fem_p2 |"));
  const auto rows = rows_of(whole_file(folder.path / "bench.csv"));
  ASSERT_GE(rows.size(), 6);
  EXPECT_EQ(rows[0][10], "displacement_error_percent");
  for (std::size_t r = 1; r < rows.size(); ++r) {
    ASSERT_EQ(rows[r].size(), rows[0].size());
    for (std::size_t k = 3; k < 14; ++k) EXPECT_TRUE(std::isfinite(std::stod(rows[r][k]))) << rows[0][k];
    EXPECT_GT(std::stod(rows[r][8]), 0);
    // The cavity grows nearly twofold; linear elements lock.
    EXPECT_NEAR(std::stod(rows[r][9]), 1.85, rows[r][1] == "fem_p1" ? 1 : 0.1);
    if (rows[r][1] == "polyaffine") {
      EXPECT_GT(std::stod(rows[r][10]), 0.1);
      EXPECT_LT(std::stod(rows[r][10]), 10);
      EXPECT_GT(std::stod(rows[r][14]), 1);
    }
  }
}

TEST(BenchCommand, ComparesBeats) {
  const TemporaryFolder folder;
  const auto run =
      run_program("bench beat --quick --quiet --protocol " PROJECT_DIR "/protocols/healthy_lv.toml --out " +
                  folder.path.string());
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, IsEmpty());
  const auto rows = rows_of(whole_file(folder.path / "bench.csv"));
  ASSERT_EQ(rows.size(), 4);
  ASSERT_GT(rows[0].size(), 26);
  EXPECT_EQ(std::vector(rows[0].begin() + 21, rows[0].begin() + 26),
            (std::vector<std::string>{"ef_error_points", "gls_error_points", "peak_strain_error",
                                      "apex_peak_strain_error", "real_time_factor"}));
  for (std::size_t r = 1; r < rows.size(); ++r) {
    ASSERT_EQ(rows[r].size(), rows[0].size());
    EXPECT_LT(std::abs(std::stod(rows[r][21])), 5);
    EXPECT_LT(std::stod(rows[r][23]), 0.3);
    EXPECT_LT(std::stod(rows[r][24]), 0.3);
    EXPECT_GT(std::stod(rows[r][25]), 0);
    EXPECT_EQ(std::stod(rows[r][23]) == 0, rows[r][1] == "fem_p2");
  }
}

TEST(BenchCommand, RefusesAnUnknownScene) {
  const auto run = run_program("bench ellipsoid_pasive --quick");
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("ellipsoid_pasive"));
  EXPECT_THAT(run.out, IsEmpty());
}

}  // namespace
