#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "program.hpp"

namespace {

using testing::HasSubstr;

TEST(ValidateCommand, NumberOutsideItsRangeIsStatusOne) {
  const TemporaryFolder folder;
  const auto out = folder.path / "out";
  const auto run = run_program(
      "validate ellipsoid --quick --expect ellipsoid/speedup_at_5_percent=0:0.001 --out " + out.string());
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.err, HasSubstr("left its range"));
  EXPECT_THAT(run.out, HasSubstr("FAIL"));
  const auto json = nlohmann::json::parse(whole_file(out / "validation.json"));
  EXPECT_FALSE(json.at("passed"));
  ASSERT_GE(json.at("checks").size(), 6);
  for (const auto& check : json.at("checks")) {
    EXPECT_EQ(check.at("case"), "ellipsoid");
    EXPECT_TRUE(check.at("value").is_number());
    EXPECT_EQ(check.at("passed"), check.at("quantity") != "speedup_at_5_percent") << check;
  }
}

TEST(ValidateCommand, WrongInputIsStatusTwo) {
  const TemporaryFolder folder;
  EXPECT_EQ(run_program("validate sphere").status, 2);
  const auto run =
      run_program("validate ellipsoid --quick --expect ellipsoid=3 --out " + folder.path.string());
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("CASE/QUANTITY=LOW:HIGH"));
}

TEST(ValidateCommand, AbsentMeshesAreNamed) {
  const TemporaryFolder folder;
  const auto run = run_program("validate elastodynamics --quick --hearts " + folder.path.string() +
                               " --out " + folder.path.string());
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("data/arostica2025/lv_surface.vtu: not found"));
  EXPECT_THAT(run.err, HasSubstr("--hearts"));
}

}  // namespace
