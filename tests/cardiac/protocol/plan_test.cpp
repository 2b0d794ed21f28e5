#include <algorithm>
#include <set>

#include <cardiac/protocol/plan.hpp>

#include "texts.hpp"

using cardiac::builds;
using cardiac::plan;

namespace {

TEST(Plan, PassiveInflationLeavesOutTheBeat) {
  const auto items = plan(cardiac::load_protocol(PROJECT_DIR "/protocols/passive_inflation.toml"));
  for (const char* part :
       {"fibres", "activation", "contraction", "circulation", "full order", "verification"}) {
    EXPECT_FALSE(builds(items, part)) << part;
  }
  for (const char* part : {"mesh", "segments", "cavity", "reduction"})
    EXPECT_TRUE(builds(items, part)) << part;
}

TEST(Plan, BeatBuildsItsParts) {
  for (const char* name : {"healthy_lv", "infarct_lv"}) {
    const auto items = plan(cardiac::load_protocol(std::string(PROJECT_DIR "/protocols/") + name + ".toml"));
    for (const char* part : {"fibres", "activation", "contraction", "cavity", "circulation", "reduction"}) {
      EXPECT_TRUE(builds(items, part)) << name << ' ' << part;
    }
    EXPECT_EQ(builds(items, "regions"), std::string(name) == "infarct_lv");
  }
}

TEST(Plan, CountsTheControlNodes) {
  const auto why = [](const std::vector<std::string>& overrides) {
    const auto items = plan(parsed(kPassive, overrides));
    return std::ranges::find(items, "reduction", &cardiac::PlanItem::part)->why;
  };
  EXPECT_THAT(why({}), testing::HasSubstr("17 control nodes (the cap + 4 + 6 + 6)"));
  EXPECT_THAT(why({"reduction.ring_nodes=[12, 8]"}), testing::HasSubstr("21 control nodes"));
}

TEST(Plan, TellsTheFunctionsAndWhetherRegionsDiffer) {
  const auto why = [](const std::string& part, const std::string& text) {
    const auto items = plan(parsed(text, {"reduction.preset=accurate"}));
    return std::ranges::find(items, part, &cardiac::PlanItem::part)->why;
  };
  const std::string region = "[[region]]\nsegments = [7]\n";
  EXPECT_THAT(why("reduction", kBeat), testing::EndsWith("affine + tt + lt + ct + ltt + ttt + ll"));
  EXPECT_THAT(why("reduction", kBeat + region + "tension_factor = 0.2\n"),
              testing::EndsWith("+ ll + lc + cc + borders of segments that differ"));
  EXPECT_THAT(why("regions", kBeat + region), testing::HasSubstr("none of which differs"));
  EXPECT_EQ(why("regions", kBeat + region + "tension_factor = 0.2\n"), "1 named by [[region]]");
}

TEST(Plan, NamedButIdlePartsAreLeftOut) {
  const auto items = plan(parsed(kPassive + "[fibres]\n[activation]\n"));
  EXPECT_FALSE(builds(items, "fibres"));
  EXPECT_FALSE(builds(items, "activation"));
}

TEST(Plan, FullOrderAndVerification) {
  const auto fem = plan(parsed(kBeat, {"reduction.method=fem"}), true);
  EXPECT_FALSE(builds(fem, "reduction"));
  EXPECT_TRUE(builds(fem, "full order"));
  EXPECT_FALSE(builds(fem, "verification"));
  const auto verified = plan(parsed(kBeat), true);
  EXPECT_TRUE(builds(verified, "reduction"));
  EXPECT_TRUE(builds(verified, "full order"));
  EXPECT_TRUE(builds(verified, "verification"));
}

TEST(Plan, OutputsAndReasons) {
  const auto items = plan(parsed(kBeat, {"output.figures=false"}));
  EXPECT_FALSE(builds(items, "figures"));
  EXPECT_TRUE(builds(items, "mesh series"));
  std::set<std::string> parts;
  for (const auto& item : items) {
    EXPECT_FALSE(item.why.empty()) << item.part;
    EXPECT_TRUE(parts.insert(item.part).second) << item.part;
  }
  EXPECT_THROW(builds(items, "wings"), std::out_of_range);
}

}  // namespace
