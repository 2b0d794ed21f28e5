#include "texts.hpp"

#include <cmath>

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

namespace {

TEST(Rules, MeshIsEitherFileOrShape) {
  EXPECT_THAT(refusal(kPassive, {"mesh.file=a.vtu"}), HasSubstr("expected one of the two"));
  const std::string file =
      "[cavities]\npressure_mmHg = 1\n[tissue]\nlaw = \"neo_hookean\"\n[mesh]\nlength_unit = \"mm\"\n";
  EXPECT_THAT(refusal(file + "file = \"heart.obj\"\n"),
              AllOf(HasSubstr("heart.toml:7: mesh.file"), HasSubstr("heart.obj"), HasSubstr(".vtu")));
  EXPECT_THAT(refusal(file + "file = \"heart.vtu\"\nendo_label = [7, 1]\nepi_label = 1\n"),
              HasSubstr("must differ"));
  EXPECT_NO_THROW(parsed(file + "file = \"heart.vtu\"\n"));
}

TEST(Rules, DirectionsMustSpanAPlane) {
  EXPECT_THAT(refusal(kPassive, {"anatomy.anterior_direction=[0, 1, 0]", "anatomy.septum_point=[1, 0, 0]"}),
              HasSubstr("expected one of anterior_direction, septum_point and rv_insertion_point"));
  EXPECT_THAT(refusal(kPassive, {"anatomy.anterior_direction=[0, 0, 0]"}), HasSubstr("length 0"));
  EXPECT_THAT(refusal(kPassive, {"anatomy.long_axis=[0, 0, 0]"}), HasSubstr("length 0"));
  EXPECT_THAT(refusal(kPassive, {"anatomy.long_axis=[0, -2, 0.01]"}), HasSubstr("parallel"));
  EXPECT_NO_THROW(parsed(kPassive, {"anatomy.long_axis=[0, -2, 0.2]"}));
}

TEST(Rules, EnrichmentAndRings) {
  for (const char* bad : {"[\"t\"]", "[\"tx\"]", "[\"tttt\"]", "[\"lt\", \"tl\"]"}) {
    EXPECT_THAT(refusal(kPassive, {std::string("reduction.enrichment=") + bad}),
                HasSubstr("letters l, c, t"));
  }
  for (const char* bad : {"[]", "[0.2, 0.2, 0.5]", "[0.5, 0.2, 0.8]", "[0, 0.5, 0.8]", "[0.2, 0.5]"}) {
    EXPECT_THAT(refusal(kPassive, {std::string("reduction.ring_positions=") + bad}), HasSubstr("rise"));
  }
  EXPECT_NO_THROW(parsed(kPassive, {"reduction.ring_positions=[0.2, 0.5]", "reduction.ring_nodes=[4, 6]"}));
  EXPECT_THAT(refusal(kPassive, {"reduction.ring_nodes=[]"}), HasSubstr("at least one ring"));
  EXPECT_THAT(refusal(kPassive, {"reduction.ring_nodes=[4, 2]"}), HasSubstr("at least 3"));
  EXPECT_THAT(refusal(kPassive, {"reduction.ring_angles_deg=[0, 30]"}), HasSubstr("each of the 3 rings"));
}

TEST(Rules, ThePressuresNeedAPartOfTheBulkModulus) {
  EXPECT_THAT(refusal(kPassive, {"tissue.bulk_modulus_kPa=6"}),
              AllOf(HasSubstr("reduction.local_bulk_modulus_kPa: found 6 kPa"), HasSubstr("which is 6 kPa")));
  EXPECT_NO_THROW(parsed(kPassive, {"tissue.bulk_modulus_kPa=6.1"}));
  EXPECT_NO_THROW(parsed(kPassive, {"tissue.bulk_modulus_kPa=6", "reduction.method=fem"}));
  EXPECT_NO_THROW(parsed(kPassive, {"tissue.bulk_modulus_kPa=6", "reduction.pressure_space=none"}));
}

TEST(Rules, ContractionRaisesALocalBulkModulusThatIsNotGiven) {
  const auto local = [](const std::string& text, const std::vector<std::string>& overrides) {
    return parsed(text, overrides).reduction.local_bulk_modulus_kPa;
  };
  EXPECT_EQ(local(kPassive, {}), 6);
  EXPECT_EQ(local(kBeat, {}), 20);
  EXPECT_EQ(local(kBeat, {"tissue.bulk_modulus_kPa=100"}), 10);
  EXPECT_EQ(local(kBeat, {"reduction.local_bulk_modulus_kPa=6"}), 6);
  EXPECT_EQ(local(kBeat, {"mesh.shape=human_biventricle"}), 6);
  EXPECT_EQ(local(kBeat, {"mesh.shape=human_biventricle", "reduction.preset=accurate"}), 20);
  EXPECT_EQ(local(kBeat, {"region=[{segments=[7], tension_factor=0}]"}), 60);
}

TEST(Rules, ContrastsBeyondTheReducedModelAreWarnedOf) {
  const auto warnings = [](const std::string& factor, const std::string& method) {
    return parsed(kPassive + "[[region]]\nsegments = [7]\nstiffness_factor = " + factor + "\n",
                  {"reduction.method=" + method})
        .warnings;
  };
  for (const char* factor : {"0.19", "31"}) {
    ASSERT_THAT(warnings(factor, "polyaffine"), SizeIs(1)) << factor;
    EXPECT_THAT(warnings(factor, "polyaffine")[0],
                AllOf(HasSubstr("region.1.stiffness_factor: found "), HasSubstr(factor)));
    EXPECT_THAT(warnings(factor, "fem"), IsEmpty());
  }
  for (const char* factor : {"0.2", "30"}) EXPECT_THAT(warnings(factor, "polyaffine"), IsEmpty()) << factor;
}

TEST(Rules, KeysOfTwoVentriclesPlayNoPartWithOne) {
  const std::string right = "circulation.right_filling_pressure_mmHg",
                    veins = "circulation.venous_pressure_mmHg";
  const auto one = parsed(kBeat, {right + "=4", veins + "=3"}).warnings;
  ASSERT_THAT(one, SizeIs(1));
  EXPECT_THAT(one[0], AllOf(HasSubstr(right), HasSubstr("it goes with anatomy.scheme = aha29")));
  const auto two = parsed(kBeat, {right + "=4", veins + "=3", "anatomy.scheme=aha29"}).warnings;
  ASSERT_THAT(two, SizeIs(1));
  EXPECT_THAT(two[0], AllOf(HasSubstr(veins), HasSubstr("it goes with anatomy.scheme = aha17")));
}

TEST(Rules, BaseThatMovesMustBeHeldAndKnown) {
  const std::vector<std::string> loose{"boundary.base=elastic", "boundary.base_normal_stiffness_kPa_per_mm=0",
                                       "boundary.base_inplane_stiffness_kPa_per_mm=0"};
  EXPECT_THAT(refusal(kPassive, loose), AllOf(HasSubstr("boundary.base_normal_stiffness_kPa_per_mm"),
                                              HasSubstr("nothing holds the heart"), HasSubstr("kPa/mm")));
  auto held = loose;
  held.emplace_back("boundary.epicardial_stiffness_kPa_per_mm=0.1");
  EXPECT_NO_THROW(parsed(kPassive, held));
  for (const char* base : {"elastic", "sliding"}) {
    const std::string moves = std::string("boundary.base=") + base;
    EXPECT_NO_THROW(parsed(kPassive, {moves}));
    EXPECT_THAT(refusal(kPassive, {moves, "reduction.weights=sigmoid"}),
                AllOf(HasSubstr("reduction.weights"), HasSubstr(base)));
    EXPECT_THAT(refusal(kPassive, {moves, "reduction.preset=tuned"}), HasSubstr("reduction.preset"));
    EXPECT_THAT(refusal(kPassive, {moves, "reduction.integration=trained"}),
                HasSubstr("reduction.integration"));
  }
  // Springs of an elastic base alone, and weights of a pericardium that is there.
  EXPECT_THAT(parsed(kPassive, {"boundary.base_normal_stiffness_kPa_per_mm=1"}).warnings, SizeIs(1));
  EXPECT_THAT(parsed(kPassive, {"boundary.epicardial_apex_weight=0.5"}).warnings, SizeIs(1));
  EXPECT_THAT(refusal(kPassive, {"boundary.epicardial_weight_array=stiff"}), HasSubstr("mesh.file"));
}

TEST(Rules, PartsThatNeedOthers) {
  const std::string shape = "[mesh]\nshape = \"human_lv\"\n";
  const std::string soft = "[tissue]\nlaw = \"neo_hookean\"\n";
  const std::string pressure = "[cavities]\npressure_mmHg = 1\n";
  EXPECT_THAT(refusal(shape + soft + pressure + "[fibres]\n[contraction]\n"), HasSubstr("[activation]"));
  EXPECT_THAT(refusal(shape + soft + pressure + "[activation]\n[contraction]\n"), HasSubstr("[fibres]"));
  EXPECT_THAT(refusal(shape + pressure), AllOf(HasSubstr("[fibres]"), HasSubstr("guccione")));
  EXPECT_NO_THROW(parsed(shape + pressure + "[tissue]\nbf = 1\nbt = 1\nbfs = 1\n"));  // isotropic
  EXPECT_THAT(refusal(shape + soft + "[circulation]\n"), HasSubstr("[contraction]"));
  EXPECT_THAT(refusal(shape + soft), HasSubstr("nothing loads"));
  EXPECT_THAT(refusal(kBeat + pressure), HasSubstr("either a prescribed pressure or a circulation"));
  EXPECT_THAT(refusal(kBeat, {"activation.mode=sites"}), HasSubstr("site_segments"));
}

TEST(Rules, SegmentsBelongToOneRegion) {
  EXPECT_THAT(
      refusal(kBeat + "[[region]]\nsegments = [1, 2]\n[[region]]\nsegments = [2]\n"),
      AllOf(HasSubstr("heart.toml:10: region.2.segments"), HasSubstr("segment 2"), HasSubstr("region 1")));
  EXPECT_THAT(refusal(kBeat + "[[region]]\nsegments = []\n"), HasSubstr("at least one segment"));
}

TEST(Rules, KeysThatPlayNoPartAreWarnedOf) {
  const auto protocol = parsed(kPassive, {"tissue.C_kPa=2"});
  ASSERT_THAT(protocol.warnings, SizeIs(1));
  EXPECT_THAT(protocol.warnings[0], AllOf(HasSubstr("tissue.C_kPa"), HasSubstr("tissue.law = guccione")));
  EXPECT_THAT(parsed(kPassive, {"mesh.length_unit=mm"}).warnings, SizeIs(1));
  EXPECT_THAT(parsed(kPassive, {"tissue.mu_kPa=2"}).warnings, IsEmpty());
}

TEST(Rules, ScalesBelongToTheHumanLeftVentricle) {
  for (const std::string key : {"mesh.cavity_scale", "mesh.wall_scale"}) {
    EXPECT_THAT(parsed(kPassive, {key + "=1.2"}).warnings, IsEmpty());
    for (const char* shape : {"land_ellipsoid", "human_biventricle"})
      EXPECT_THAT(parsed(kPassive, {key + "=1.2", std::string("mesh.shape=") + shape}).warnings,
                  ElementsAre(HasSubstr(key + " plays no part")))
          << shape;
    EXPECT_THAT(refusal(kPassive, {key + "=0"}), HasSubstr(key));
    EXPECT_THAT(refusal(kPassive, {key + "=10"}), HasSubstr(key));
  }
  EXPECT_EQ(parsed(kPassive).mesh.cavity_scale, 1);
  EXPECT_EQ(parsed(kPassive).mesh.wall_scale, 1);
}

TEST(Rules, SystoleFollowsTheHeartRateUnlessItIsGiven) {
  const auto duration = [](const std::vector<std::string>& overrides) {
    return *parsed(kBeat, overrides).contraction->activation_duration_ms;
  };
  EXPECT_EQ(duration({"time.heart_rate_bpm=75"}), 324);
  // Bazett: twice the rate, 1/√2 of the duration; four times the rate, half of it.
  EXPECT_NEAR(duration({"time.heart_rate_bpm=150"}), 324 / std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(duration({"time.heart_rate_bpm=300"}), 162, 1e-9);
  EXPECT_NEAR(duration({"time.heart_rate_bpm=190"}), 324 * std::sqrt(75 / 190.0), 1e-9);
  // Beyond, systole is in proportion to the beat.
  EXPECT_NEAR(duration({"time.heart_rate_bpm=600"}), 81, 1e-9);
  EXPECT_EQ(duration({"time.heart_rate_bpm=150", "contraction.activation_duration_ms=200"}), 200);
}

TEST(Rules, ContractionMustFitIntoABeat) {
  // 60000/190 ms is shorter than the 324 ms given; one of 315 leaves no time to relax.
  for (const char* given : {"324", "315"})
    EXPECT_THAT(refusal(kBeat, {"time.heart_rate_bpm=190",
                                std::string("contraction.activation_duration_ms=") + given}),
                AllOf(HasSubstr("contraction.activation_duration_ms"), HasSubstr("time.heart_rate_bpm = 190"),
                      HasSubstr("315.789"), HasSubstr(given)));
  EXPECT_NO_THROW(parsed(kBeat, {"time.heart_rate_bpm=190", "contraction.activation_duration_ms=200"}));
  EXPECT_NO_THROW(parsed(kBeat, {"time.heart_rate_bpm=190"}));
}

TEST(Rules, EachConditionThatIsNotMetIsNamed) {
  const auto told = [](const std::string& text, const std::string& setting, const std::string& unmet) {
    const auto warnings = parsed(text, {setting}).warnings;
    ASSERT_THAT(warnings, SizeIs(1)) << setting;
    EXPECT_THAT(warnings[0],
                AllOf(HasSubstr(setting.substr(0, setting.find('=')) + " plays no part: it goes with "),
                      testing::EndsWith(unmet)));
  };
  const std::string full = kBeat + "[reduction]\nmethod = \"fem\"\n";
  told(full, "reduction.preset=accurate", "reduction.method = polyaffine");
  told(full, "reduction.sigmoid_slope=2", "reduction.weights = sigmoid, with reduction.method = polyaffine");
  told(kBeat, "reduction.element_order=1", "reduction.method = fem");
  told(kPassive, "time.heart_rate_bpm=60", "[contraction] or a file of [cavities]");
  told(kPassive, "time.max_beats=3", "[circulation]");
  told(kBeat, "time.load_steps=3", "a run without [circulation]");
  told(kBeat, "fibres.sheet_angle_deg=10", "tissue.law = holzapfel_ogden");
  told(kBeat, "fibres.rv_endo_angle_deg=10", "anatomy.scheme = aha29");
  told(kPassive, "fibres.endo_angle_deg=10", "[contraction] or an anisotropic tissue.law");
  told(kPassive, "activation.onset_ms=10", "[contraction]");
  told(kPassive + "[[region]]\nsegments = [1]\n", "region.1.tension_factor=0", "[contraction]");
  told(kBeat + "[[region]]\nsegments = [1]\n", "region.1.border_width_percent=0",
       "a factor or delay of its [[region]] that differs from the rest");
}

}  // namespace
