#include "cardiac/validation/check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include <polyaffine/core/error.hpp>

namespace cardiac {
namespace {

Check check_of(const std::string& quantity, double value, double low, double high) {
  Check c;
  c.case_name = "land1";
  c.method = "fem_p2";
  c.quantity = quantity;
  c.unit = "mm";
  c.value = value;
  c.reference = 4.17;
  c.low = low;
  c.high = high;
  return c;
}

TEST(Check, PassesInsideItsRangeEndsIncluded) {
  EXPECT_TRUE(check_of("z_mm", 4.16, 4.16, 4.18).passed());
  EXPECT_TRUE(check_of("z_mm", 4.18, 4.16, 4.18).passed());
  EXPECT_FALSE(check_of("z_mm", 4.19, 4.16, 4.18).passed());
  EXPECT_FALSE(check_of("z_mm", std::numeric_limits<double>::quiet_NaN(), 4.16, 4.18).passed());
}

TEST(Check, OneFailureFailsTheWhole) {
  std::vector<Check> checks{check_of("z_mm", 4.17, 4.16, 4.18), check_of("x_mm", 9.1, 9, 9.2)};
  EXPECT_TRUE(nlohmann::json::parse(validation_text(checks))["passed"]);
  apply_expectation(parse_expectation("land1/x_mm=9.15:9.2"), checks);
  const auto json = nlohmann::json::parse(validation_text(checks));
  EXPECT_FALSE(json["passed"]);
  EXPECT_TRUE(json["checks"][0]["passed"]);
  EXPECT_FALSE(json["checks"][1]["passed"]);
  EXPECT_EQ(json["checks"][1]["low"], 9.15);
}

TEST(Check, NumbersThatAreNotFiniteAreNull) {
  const auto json = nlohmann::json::parse(
      validation_text({check_of("z_mm", std::numeric_limits<double>::infinity(), 0, 1)}));
  EXPECT_TRUE(json["checks"][0]["value"].is_null());
  EXPECT_FALSE(json["checks"][0]["passed"]);
}

TEST(Check, WrongOverridesAreNamed) {
  std::vector<Check> checks{check_of("z_mm", 4.17, 4.16, 4.18)};
  EXPECT_THROW(parse_expectation("land1/z_mm"), polyaffine::InputError);
  EXPECT_THROW(parse_expectation("land1/z_mm=a:b"), polyaffine::InputError);
  EXPECT_THROW(apply_expectation(parse_expectation("land1/y_mm=0:1"), checks), polyaffine::InputError);
}

}  // namespace
}  // namespace cardiac
