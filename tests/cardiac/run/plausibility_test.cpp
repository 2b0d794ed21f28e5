#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include <cardiac/run/plausibility.hpp>

namespace cardiac {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

BeatResult healthy() {
  BeatResult r;
  r.completed = r.has_beat = true;
  r.segments = {{1, "basal anterior", 94, {}}};
  r.min_det_F = 0.8;
  r.instants.resize(2);
  r.instants[0].strain = {SegmentStrain{}};
  r.instants[1].time_ms = 300;
  r.instants[1].strain = {SegmentStrain{-0.15, -0.18, 0.4, 0, 0, 0, 0.99}};
  VentricleSummary lv{"lv", 119, 51, 68, 57, 120, 10, 100, 400, {{0, 119, 10}, {400, 51, 90}}};
  r.ventricles = {lv};
  return r;
}

template <class Change>
std::vector<std::string> changed(const Change& change) {
  BeatResult r = healthy();
  change(r);
  return absurdities(r);
}

TEST(Plausibility, AHealthyBeatPasses) {
  EXPECT_THAT(absurdities(healthy()), IsEmpty());
}

TEST(Plausibility, EachAbsurdityIsNamedAlone) {
  const auto lv = [](auto member, double value) {
    return changed([&](BeatResult& r) { r.ventricles[0].*member = value; });
  };
  EXPECT_THAT(lv(&VentricleSummary::ef_percent, -1.8),
              ElementsAre("lv: the ejection fraction is -1.8 %, expected 0 to 95 %"));
  EXPECT_THAT(lv(&VentricleSummary::ef_percent, 96),
              ElementsAre("lv: the ejection fraction is 96 %, expected 0 to 95 %"));
  EXPECT_THAT(lv(&VentricleSummary::peak_pressure_mmHg, 501),
              ElementsAre("lv: the peak pressure is 501 mmHg, expected at most 500 mmHg"));
  EXPECT_THAT(lv(&VentricleSummary::edv_mL, 2649.5),
              ElementsAre(AllOf(HasSubstr("2650 mL in a wall of 94 mL"), HasSubstr("10 times"))));
  EXPECT_THAT(changed([](BeatResult& r) { r.min_det_F = 0.099; }),
              ElementsAre(AllOf(HasSubstr("compressed to 9.9 %"), HasSubstr("at least 10 %"))));
  EXPECT_THAT(changed([](BeatResult& r) { r.instants[1].strain[0].volume_ratio = 2.5; }),
              ElementsAre("segment 1 had 250 % of its volume at 300 ms, expected 50 to 200 %"));
  EXPECT_THAT(changed([](BeatResult& r) { r.ventricles[0].samples[1].volume_mL = -3; }),
              ElementsAre("lv: the cavity had -3 mL at 400 ms: turned inside out"));
  EXPECT_THAT(changed([](BeatResult& r) { r.strain.twist_deg = std::nan(""); }),
              ElementsAre(HasSubstr("a number that is none")));
}

TEST(Plausibility, BoundsThemselvesPass) {
  EXPECT_THAT(changed([](BeatResult& r) {
                r.min_det_F = 0.1;
                r.ventricles[0].ef_percent = 95;
                r.instants[1].strain[0].volume_ratio = 0.5;
              }),
              IsEmpty());
  EXPECT_THAT(changed([](BeatResult& r) { r.ventricles[0].ef_percent = 0; }), IsEmpty());
}

// A prescribed pressure may be anything, and has no ejection fraction.
TEST(Plausibility, WithoutABeatOnlyWallAndCavityAreHeldToBounds) {
  EXPECT_THAT(changed([](BeatResult& r) {
                r.has_beat = false;
                VentricleSummary& v = r.ventricles[0];
                v.edv_mL = v.esv_mL = v.ef_percent = v.edp_mmHg = std::nan("");
                v.peak_pressure_mmHg = 900;
              }),
              IsEmpty());
}

TEST(Plausibility, ASegmentWithoutWallHasNoStrain) {
  EXPECT_THAT(changed([](BeatResult& r) {
                r.segments.push_back({2, "basal anteroseptal", 0, {}});
                r.instants[1].strain.push_back({NAN, NAN, NAN, NAN, NAN, NAN, NAN});
              }),
              IsEmpty());
}

}  // namespace
}  // namespace cardiac
