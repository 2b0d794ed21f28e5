#include "texts.hpp"

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

namespace {

const std::string kTwoRegions = kBeat + "[[region]]\nsegments = [1]\n[[region]]\nsegments = [2]\n";

TEST(Override, ReplacesAddsAndOpensTables) {
  const auto protocol = parsed(kBeat, {"tissue.C_kPa=3.5", "time.heart_rate_bpm = 60", "reduction.method=fem",
                                       "tissue.C_kPa=4", "anatomy.anterior_direction=[1, 0, 0]"});
  EXPECT_EQ(protocol.tissue.C_kPa, 4);  // the last one counts
  EXPECT_EQ(protocol.time.beat_ms, 1000);
  EXPECT_EQ(protocol.reduction.method, cardiac::protocol::Method::fem);
  EXPECT_EQ(protocol.anatomy.anterior_direction, (cardiac::protocol::Vector3{1, 0, 0}));
  const std::string file = "[mesh]\nfile = \"a.vtu\"\nlength_unit = \"mm\"\n";
  EXPECT_EQ(parsed(file + kPassive.substr(kPassive.find("[tissue]")), {"mesh.file=../b.vtu"}).mesh.file,
            "../../b.vtu");  // a path needs no quotes
  EXPECT_EQ(parsed(kPassive, {"fibres.endo_angle_deg=70"}).fibres->endo_angle_deg, 70);
  EXPECT_EQ(parsed(kPassive, {"tissue={law=\"mooney_rivlin\", c1_kPa=2}"}).tissue.c1_kPa, 2);
}

TEST(Override, PathsStartAtTheCurrentFolder) {
  // The protocol of these texts is folder/heart.toml.
  const std::string file = "[mesh]\nfile = \"a.vtu\"\nlength_unit = \"mm\"\nsurface_file = \"s.vtp\"\n";
  const std::string text = file + kPassive.substr(kPassive.find("[tissue]"));
  EXPECT_EQ(mesh_path(parsed(text)), "folder/a.vtu");
  const auto given = [&](const std::string& word) { return parsed(text, {"mesh.file=" + word}); };
  EXPECT_EQ(mesh_path(given("b.vtu")), "b.vtu");
  EXPECT_EQ(given("b.vtu").mesh.file, "../b.vtu");  // as the protocol file would name it
  EXPECT_EQ(mesh_path(given("./folder/b.vtu")), "folder/b.vtu");
  EXPECT_EQ(given("folder/b.vtu").mesh.file, "b.vtu");
  EXPECT_EQ(mesh_path(given("../b.vtu")), "../b.vtu");
  EXPECT_EQ(given("/data/b.vtu").mesh.file, "/data/b.vtu");
  EXPECT_EQ(surface_path(parsed(text, {"mesh.surface_file=\"b.vtp\""})), "b.vtp");
  const std::string one_file = text.substr(0, text.find("surface_file")) + text.substr(text.find("[tissue]"));
  const auto files = parsed(one_file, {"mesh.surface_files=[\"endo=b.vtp\", \"c.vtp\"]"}).mesh.surface_files;
  EXPECT_EQ(*files, (std::vector<std::string>{"endo=../b.vtp", "../c.vtp"}));
  EXPECT_EQ(mesh_path(parsed(text, {"mesh={file=\"b.vtu\", length_unit=\"mm\"}"})), "b.vtu");
}

TEST(Override, ReachesRegions) {
  const auto one = parsed(kTwoRegions, {"region.2.tension_factor=0.5"}).regions;
  ASSERT_EQ(one.size(), 2u);
  EXPECT_EQ(one[0].tension_factor, 1);
  EXPECT_EQ(one[1].tension_factor, 0.5);
  EXPECT_EQ(one[1].segments, std::vector<int>{2});
  const auto all = parsed(kTwoRegions, {"region=[{segments=[5], stiffness_factor=4}]"}).regions;
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].segments, std::vector<int>{5});
  EXPECT_TRUE(parsed(kTwoRegions, {"region=[]"}).regions.empty());
}

TEST(Override, ErrorsNameTheOption) {
  EXPECT_EQ(refusal(kPassive, {"tissue.mu_kPa=soft"}),
            "--set tissue.mu_kPa=soft: tissue.mu_kPa: found the text \"soft\", expected a number in kPa, "
            "above 0, "
            "at most 1000000 kPa");
  EXPECT_THAT(refusal(kPassive, {"tissue.mu_kPa=-1"}), AllOf(StartsWith("--set "), HasSubstr("above 0")));
  EXPECT_THAT(refusal(kPassive, {"tisue.mu_kPa=1"}), HasSubstr("nearest known table is tissue"));
  EXPECT_THAT(refusal(kPassive, {"tissue.mu_kPa"}), HasSubstr("expected key.path=value"));
  EXPECT_THAT(refusal(kPassive, {"tissue.mu_kPa="}), HasSubstr("expected key.path=value"));
  EXPECT_THAT(refusal(kPassive, {"=1"}), HasSubstr("expected key.path=value"));
  EXPECT_THAT(refusal(kPassive, {"tissue.mu_kPa=[1"}),
              AllOf(StartsWith("--set "), HasSubstr("not valid TOML")));
  EXPECT_THAT(refusal(kPassive, {"tissue=3"}), HasSubstr("expected a table [tissue]"));
  EXPECT_THAT(refusal(kPassive, {"tissue.mu_kPa=1\nfibres.rule=2"}), StartsWith("--set "));
  EXPECT_THAT(refusal(kTwoRegions, {"region.3.tension_factor=0"}), HasSubstr("only 2 entries [[region]]"));
  EXPECT_THAT(refusal(kTwoRegions, {"region.tension_factor=0"}), HasSubstr("region.1.KEY=VALUE"));
}

}  // namespace
