#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cardiac/anatomy/wall_size.hpp>
#include <polyaffine/core/error.hpp>

#include "support/error_of.hpp"

namespace cardiac {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

std::string refusal(double volume_mm3, double mm_per_unit) {
  return polyaffine::testing::error_of([&] { check_wall_size(volume_mm3, mm_per_unit, {}); });
}

// Left ventricles in mm³: of mice 80 to 110 mg, of a rat 0.28 mL (a mesh in use), of people 70 to 200 mL, of
// a horse 3.5 L.
TEST(WallSize, HeartsFromMouseToHorsePass) {
  for (const double mm3 : {76.0, 105.0, 283.0, 800.0, 70e3, 200e3, 3.5e6})
    EXPECT_EQ(check_wall_size(mm3, 1, {}), "") << mm3;
}

TEST(WallSize, AHumanHeartInAWrongUnitIsRefusedWithTheRightOne) {
  const double human_mm3 = 94e3;
  EXPECT_THAT(refusal(human_mm3 * 1e9, 1000),
              AllOf(HasSubstr("mesh.length_unit: the wall has 9.4e+10 mL in m, "),
                    HasSubstr("it would be 94 mL in mm (--force insists)"), Not(HasSubstr(" or "))));
  EXPECT_THAT(refusal(human_mm3 * 1e3, 10),
              AllOf(HasSubstr("in cm, "), HasSubstr("it would be 94 mL in mm")));
  // Read in mm, its coordinates are metres.
  EXPECT_THAT(refusal(human_mm3 * 1e-9, 1),
              AllOf(HasSubstr("in mm, "), HasSubstr("it would be 94 mL in m (")));
  // What would be a small heart in mm would be a horse's in cm.
  EXPECT_THAT(refusal(1e-6, 1e-3), HasSubstr("it would be 1 mL in mm or 1000 mL in cm"));
}

TEST(WallSize, WhatNoUnitMendsSaysSo) {
  EXPECT_THAT(refusal(1e-30, 1), HasSubstr("no unit would do"));
}

TEST(WallSize, InsistedUponItIsTold) {
  const std::string told = check_wall_size(1e12, 1000, {"--length-unit", true});
  EXPECT_THAT(told, AllOf(HasSubstr("--length-unit: the wall has 1e+09 mL in m"), Not(HasSubstr("--force"))));
}

}  // namespace
}  // namespace cardiac
