#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cardiac/report/normal_values.hpp>
#include <cardiac/report/protocol_facts.hpp>

namespace cardiac {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

std::string assumptions(const std::string& protocol, bool right = false) {
  std::string all;
  for (const std::string& sentence : assumptions_of(protocol, right)) all += sentence + "\n";
  return all;
}

TEST(ProtocolFacts, RegionsHaveNamesAndSegments) {
  const auto regions = regions_of(
      R"({"region": [{"name": "scar", "segments": [1, 2]}, {"segments": [9]}, {"name": "none", "segments": []}]})");
  ASSERT_EQ(regions.size(), 2);
  EXPECT_EQ(regions[0].name, "scar");
  EXPECT_THAT(regions[0].segments, ElementsAre(1, 2));
  EXPECT_EQ(regions[1].name, "region 2");
}

TEST(ProtocolFacts, WhatIsNotAProtocolHasNoRegions) {
  for (const char* text :
       {"", "{", "[]", "3", R"({"region": 3})", R"({"region": [3, {"name": 4}, {"segments": "x"}]})",
        R"({"mesh": 1, "boundary": {"base": 2}, "anatomy": {"long_axis": 3}})"}) {
    EXPECT_TRUE(regions_of(text).empty()) << text;
    EXPECT_EQ(assumptions_of(text, false).size(), 5) << text;
  }
}

TEST(ProtocolFacts, AssumptionsFollowWhatIsGiven) {
  const std::string plain = assumptions(R"({"boundary": {"base": "clamped"}})");
  for (const char* text : {"free of stress", "base is clamped", "Nothing holds the outer wall",
                           "runs from the apex", "taken to lie in the direction (0, 1, 0)"})
    EXPECT_THAT(plain, HasSubstr(text));
  const std::string given = assumptions(
      R"({"mesh": {"pressure_mmHg": 9.5}, "anatomy": {"long_axis": [0.0, 0.0, 1.0], "anterior_direction": [1.0, 0.5, 0.0]},
          "boundary": {"base": "springs", "epicardial_stiffness_kPa_per_mm": 0.2}})");
  for (const char* text :
       {"imaged at 9.5 mmHg", "boundary.base = springs", "0.2 kPa/mm", "(0, 0, 1)", "(1, 0.5, 0)"})
    EXPECT_THAT(given, HasSubstr(text));
  for (const char* text : {"free of stress", "is clamped", "Nothing holds", "(0, 1, 0)"})
    EXPECT_THAT(given, Not(HasSubstr(text)));
  EXPECT_THAT(given, HasSubstr("along the normal hold"));
  const std::string damped = assumptions(
      R"({"boundary": {"epicardial_damping_kPa_ms_per_mm": 5.0, "epicardial_directions": "all"}})");
  EXPECT_THAT(damped, HasSubstr("Dashpots of 5 kPa·ms/mm in all directions hold the outer wall"));
  const std::string point = assumptions(R"({"anatomy": {"septum_point": [-30.0, 2.0, 0.0]}})");
  EXPECT_THAT(point, HasSubstr("anatomy.septum_point = (-30, 2, 0)"));
  EXPECT_THAT(point, Not(HasSubstr("(0, 1, 0)")));
  EXPECT_THAT(assumptions("{}", true), HasSubstr("right ventricle tells"));
}

TEST(NormalValues, PlaceAValueInWords) {
  const NormalValue& ef = normal_value(Measured::lv_ef);
  EXPECT_EQ(ef.range(), "50 to 70");
  EXPECT_EQ(ef.place_of(49.9), "lower");
  EXPECT_EQ(ef.place_of(70), "within");
  EXPECT_EQ(ef.place_of(71), "higher");
  EXPECT_EQ(ef.place_of(NAN), "");
  // Shortening is negative, thickening positive.
  EXPECT_EQ(normal_value(Measured::gls).place_of(-14.6), "weaker");
  EXPECT_EQ(normal_value(Measured::gls).place_of(-25), "stronger");
  EXPECT_EQ(normal_value(Measured::grs).place_of(20), "weaker");
  EXPECT_EQ(normal_value(Measured::grs).place_of(90), "stronger");
  EXPECT_EQ(normal_value(Measured::lv_esv).place_of(50), "");
  EXPECT_EQ(normal_value(Measured::lv_esv).range(), "about 50");
}

TEST(NormalValues, SpanWhatIsPublishedAndNameTheirSource) {
  for (int i = 0; i <= static_cast<int>(Measured::rv_gls); ++i) {
    const NormalValue& normal = normal_value(static_cast<Measured>(i));
    ASSERT_FALSE(normal.published.empty());
    for (const PublishedValue& p : normal.published) EXPECT_FALSE(p.source.empty()) << normal.name;
  }
  EXPECT_EQ(normal_value(Measured::rv_gls).range(), "−23.3 to −20.2");
  EXPECT_EQ(normal_value(Measured::rv_peak_pressure).range(), "20 to 32");
}

}  // namespace
}  // namespace cardiac
