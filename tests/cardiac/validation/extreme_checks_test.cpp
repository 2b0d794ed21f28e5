#include "cardiac/validation/extreme_checks.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace cardiac {
namespace {

const ValidationContext context{
    .quick = true, .out = {}, .mesh_ellipsoid = {}, .mesh_box = {}, .mesh_biventricle = {}, .hearts = {}};

ExtremeOutcome inflation(const ExtremeChecks& checks, const std::string& setting) {
  return checks.run("test", checks.coarse_wall(), kExtremePassive, {setting, "time.load_steps=2"});
}

TEST(ExtremeChecks, ACompletedRunMustLieInItsRange) {
  ExtremeChecks checks(context);
  const auto outcome = inflation(checks, "cavities.pressure_mmHg=1");
  ASSERT_TRUE(outcome.completed());
  const double ratio = outcome.cavity_ratio();
  EXPECT_GT(ratio, 1);
  checks.expect(outcome, "cavity_ratio", "1", ratio, {1, 1, 2, "test"});
  checks.expect(outcome, "cavity_ratio", "1", ratio, {1, 0, 1, "test"});
  checks.expect_refusal(outcome, "");
  ASSERT_EQ(checks.checks().size(), 3U);
  EXPECT_TRUE(checks.checks()[0].passed());
  EXPECT_FALSE(checks.checks()[1].passed());
  EXPECT_FALSE(checks.checks()[2].passed()) << "it did not stop";
  const auto record = nlohmann::json::parse(validation_text(checks.checks()))["checks"][0]["record"];
  EXPECT_GE(record["steps"], 2);
  EXPECT_GT(record["newton_iterations"], 2);
  EXPECT_EQ(record["outcome"], "completed");
}

TEST(ExtremeChecks, AStoppedRunNeedsAReasonAndIsNoSuccess) {
  ExtremeChecks checks(context);
  const auto outcome = inflation(checks, "cavities.pressure_mmHg=300");
  EXPECT_FALSE(outcome.completed());
  EXPECT_GT(outcome.path.steps.size(), 1U) << "what was reached is kept";
  checks.expect(outcome, "cavity_ratio", "1", 1, {1, 0, 2, "test"});
  checks.expect_or_stop(outcome, "cavity_ratio", "1", 1, {1, 0, 2, "test"}, kNoEquilibrium);
  checks.expect_refusal(outcome, "limit load");
  checks.expect_refusal(outcome, "words that it does not say");
  EXPECT_FALSE(checks.checks()[0].passed());
  EXPECT_TRUE(checks.checks()[1].passed());
  EXPECT_TRUE(checks.checks()[2].passed());
  EXPECT_FALSE(checks.checks()[3].passed());
  EXPECT_NE(checks.checks()[0].record->outcome.find("% of the load"), std::string::npos);
}

TEST(ExtremeChecks, WrongInputIsARefusalThatIsKept) {
  ExtremeChecks checks(context);
  checks.expect_refusal(inflation(checks, "tissue.mu_kPa=-1"), "tissue.mu_kPa");
  EXPECT_TRUE(checks.checks()[0].passed());
}

}  // namespace
}  // namespace cardiac
