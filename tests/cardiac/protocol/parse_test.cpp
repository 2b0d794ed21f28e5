#include <filesystem>
#include <fstream>

#include <cardiac/core/units.hpp>
#include <cardiac/protocol/names.hpp>

#include "texts.hpp"

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

namespace {

TEST(Parse, ReadsValuesOfEveryType) {
  const auto protocol = parsed(
      "[mesh]\nfile = \"../heart.vtu\"\nlength_unit = \"cm\"\nendo_label = 7\nepi_label = [8, \"outer\"]\n"
      "[anatomy]\nanterior_direction = [1, 0, 0.5]\n"
      "[reduction]\npressure_space = \"segment_linear\"\nenrichment = [\"tt\", \"lt\"]\nring_positions = "
      "[0.2, 0.5]\nring_nodes = [3, 8]\nring_angles_deg = [0, 22.5]\n"
      "[tissue]\nC_kPa = 3\n[fibres]\n[activation]\nmode = \"sites\"\nsite_segments = [3, 9]\n"
      "sites_mm = [[1, 2, 3]]\n[contraction]\n[circulation]\n[output]\nfigures = false\n");
  EXPECT_EQ(protocol.mesh.file, "../heart.vtu");
  EXPECT_EQ(cardiac::mesh_path(protocol), "heart.vtu");  // beside the folder of the protocol
  EXPECT_EQ(protocol.mesh.length_unit, cardiac::protocol::LengthUnit::cm);
  EXPECT_EQ(protocol.mesh.endo_label, (cardiac::protocol::Labels{7}));
  EXPECT_EQ(protocol.mesh.epi_label, (cardiac::protocol::Labels{8, "outer"}));
  EXPECT_FALSE(protocol.mesh.base_label);
  EXPECT_EQ(protocol.anatomy.anterior_direction, (cardiac::protocol::Vector3{1, 0, 0.5}));
  EXPECT_EQ(protocol.reduction.pressure_space, cardiac::protocol::PressureSpace::segment_linear);
  EXPECT_EQ(protocol.reduction.enrichment, (std::vector<std::string>{"tt", "lt"}));
  EXPECT_EQ(protocol.reduction.ring_positions, (std::vector<double>{0.2, 0.5}));
  EXPECT_EQ(protocol.reduction.ring_nodes, (std::vector<int>{3, 8}));
  EXPECT_EQ(protocol.reduction.ring_angles_deg, (std::vector<double>{0, 22.5}));
  EXPECT_EQ(protocol.tissue.C_kPa, 3);
  EXPECT_EQ(protocol.activation->site_segments, (std::vector<int>{3, 9}));
  EXPECT_EQ(protocol.activation->sites_mm, (std::vector<cardiac::protocol::Vector3>{{1, 2, 3}}));
  EXPECT_FALSE(protocol.output.figures);
  EXPECT_TRUE(protocol.warnings.empty());
}

TEST(Parse, AbsentTablesStayAbsentAndNamedOnesTakeDefaults) {
  const auto passive = parsed(kPassive);
  EXPECT_FALSE(passive.fibres || passive.activation || passive.contraction || passive.circulation);
  ASSERT_TRUE(passive.cavities);
  EXPECT_EQ(passive.cavities->pressure_kPa, 7.5 * cardiac::kPa_per_mmHg);
  const auto beat = parsed(kBeat);
  EXPECT_TRUE(beat.fibres && beat.activation && beat.contraction && beat.circulation);
  EXPECT_FALSE(beat.cavities);
  EXPECT_EQ(beat.fibres->endo_angle_deg, 70);
  EXPECT_EQ(beat.fibres->epi_angle_deg, -70);
}

TEST(Parse, PresetsBendTheWallWhereRegionsDiffer) {
  using Words = std::vector<std::string>;
  const std::string region = "[[region]]\nsegments = [7]\n";
  const auto enrichment = [](const std::string& text, const std::string& preset = "accurate") {
    return *parsed(text, {"reduction.preset=" + preset}).reduction.enrichment;
  };
  const auto borders = [](const std::string& text, const std::vector<std::string>& more = {}) {
    std::vector<std::string> settings{"reduction.preset=accurate"};
    settings.insert(settings.end(), more.begin(), more.end());
    return *parsed(text, settings).reduction.border_functions;
  };
  const Words alike{"tt", "lt", "ct", "ltt", "ttt", "ll"};
  const Words differing{"tt", "lt", "ct", "ltt", "ttt", "ll", "lc", "cc"};
  EXPECT_EQ(enrichment(kBeat), alike);
  EXPECT_EQ(enrichment(kBeat + region), alike);
  for (const char* key : {"tension_factor", "stiffness_factor", "activation_delay_ms"})
    EXPECT_EQ(enrichment(kBeat + region + key + " = 0.5\n"), differing) << key;
  EXPECT_EQ(enrichment(kBeat + region, "fast"), (Words{"tt", "lt"}));
  EXPECT_EQ(enrichment(kBeat + region + "tension_factor = 0.5\n", "fast"),
            (Words{"tt", "lt", "ct", "lc", "cc", "ll"}));
  // Nothing contracts: of the factors only the stiffness plays a part.
  EXPECT_EQ(enrichment(kPassive + region + "tension_factor = 0.5\n"), alike);
  EXPECT_EQ(enrichment(kPassive + region + "stiffness_factor = 0.5\n"), differing);
  const std::string weak = kBeat + region + "tension_factor = 0.5\n";
  EXPECT_FALSE(borders(kBeat + region));
  EXPECT_TRUE(borders(weak));
  EXPECT_TRUE(borders(weak, {"reduction.preset=fast"}));
  EXPECT_FALSE(borders(weak, {"reduction.border_functions=false"}));
  EXPECT_FALSE(borders(weak, {"reduction.ring_nodes=[4, 8, 8, 8]"}));
  EXPECT_FALSE(borders(weak, {"reduction.weights=sigmoid"}));
}

TEST(Parse, SchemeFollowsTheShapeAndAxesTheWall) {
  using cardiac::protocol::Axes;
  using cardiac::protocol::Scheme;
  const auto one = parsed(kBeat), two = parsed(kBeat, {"mesh.shape=human_biventricle"});
  EXPECT_EQ(one.anatomy.scheme, Scheme::aha17);
  EXPECT_EQ(one.reduction.axes, Axes::automatic);
  EXPECT_EQ(two.anatomy.scheme, Scheme::aha29);
  EXPECT_EQ(two.reduction.axes, Axes::automatic);
  EXPECT_FALSE(one.scheme_assumed || two.scheme_assumed);
  EXPECT_EQ(parsed(kBeat, {"mesh.shape=human_biventricle", "reduction.axes=heart"}).reduction.axes,
            Axes::heart);
  // A mesh file tells only when it is read; until then any segment may be named.
  const std::string file =
      "[mesh]\nfile = \"heart.vtu\"\nlength_unit = \"mm\"\n" + kBeat.substr(kBeat.find("[fibres]"));
  EXPECT_TRUE(parsed(file).scheme_assumed);
  EXPECT_FALSE(parsed(file, {"anatomy.scheme=aha17"}).scheme_assumed);
  const std::string right = file + "[[region]]\nsegments = [20]\n";
  EXPECT_NO_THROW(parsed(right));
  EXPECT_THAT(refusal(right, {"anatomy.scheme=aha17"}), HasSubstr("found segment 20, expected at most 17"));
}

TEST(Parse, PresetFillsWhatTheFileLeavesOut) {
  using cardiac::protocol::PressureSpace;
  const auto fast = parsed(kPassive).reduction;
  EXPECT_EQ(fast.enrichment, (std::vector<std::string>{"tt", "lt"}));
  EXPECT_EQ(fast.pressure_space, PressureSpace::segment_linear);
  const auto sigmoid = parsed(kPassive + "[reduction]\nweights = \"sigmoid\"\n").reduction;
  EXPECT_EQ(sigmoid.pressure_space, PressureSpace::segment_depth);
  const auto accurate = parsed(kPassive + "[reduction]\npreset = \"accurate\"\nenrichment = []\n").reduction;
  EXPECT_EQ(accurate.enrichment, std::vector<std::string>{});
  EXPECT_EQ(accurate.pressure_space, PressureSpace::segment_linear);
}

TEST(Parse, CartesianAxesHaveTheFunctionsOfAffineMapsOnACurvedWall) {
  using Words = std::vector<std::string>;
  const auto enrichment = [](const std::vector<std::string>& settings) {
    return *parsed(kBeat, settings).reduction.enrichment;
  };
  const Words fast{"tt", "lt", "ct", "lc", "cc"};
  const Words accurate{"tt", "lt", "ct", "ltt", "ttt", "ll", "lc", "cc", "ctt", "llt", "cct"};
  EXPECT_EQ(enrichment({"reduction.axes=cartesian"}), fast);
  EXPECT_EQ(enrichment({"mesh.shape=human_biventricle"}), fast);
  EXPECT_EQ(enrichment({"mesh.shape=human_biventricle", "reduction.axes=heart"}), (Words{"tt", "lt"}));
  EXPECT_EQ(enrichment({"mesh.shape=human_biventricle", "reduction.preset=accurate"}), accurate);
}

TEST(Parse, WordsMeanTheirValues) {
  using cardiac::protocol::TissueLaw;
  const std::vector<std::pair<std::string, TissueLaw>> laws = {
      {"guccione", TissueLaw::guccione},
      {"holzapfel_ogden", TissueLaw::holzapfel_ogden},
      {"neo_hookean", TissueLaw::neo_hookean},
      {"mooney_rivlin", TissueLaw::mooney_rivlin},
      {"saint_venant_kirchhoff", TissueLaw::saint_venant_kirchhoff}};
  for (const auto& [word, law] : laws) {
    EXPECT_EQ(parsed(kBeat, {"tissue.law=" + word}).tissue.law, law);
    EXPECT_EQ(cardiac::protocol::name_of(law), word);
  }
}

TEST(Parse, UnknownKeyNamesTheNearestOne) {
  EXPECT_THAT(refusal(kPassive + "[tissue2]\n"),
              AllOf(StartsWith("folder/heart.toml:7: tissue2"), HasSubstr("tissue")));
  const std::string wrong = "[mesh]\nshape = \"human_lv\"\n[tissue]\nlaw = \"guccione\"\nC_kpa = 2\n";
  EXPECT_EQ(refusal(wrong),
            "folder/heart.toml:5: tissue.C_kpa: unknown key; the nearest known key is tissue.C_kPa");
  EXPECT_THAT(refusal(kPassive + "[reduction]\nmetod = \"fem\"\n"),
              HasSubstr("nearest known key is reduction.method"));
  EXPECT_THAT(refusal(kPassive + "[tissue.mu]\nx = 1\n"), HasSubstr("tissue.mu_kPa"));
  EXPECT_THAT(refusal("[mehs]\nfile = \"a.vtu\"\n"), HasSubstr("mesh"));
  EXPECT_THAT(refusal("heart_rate_bpm = 60\n"), HasSubstr("nearest known key is time.heart_rate_bpm"));
  EXPECT_THAT(refusal(kPassive + "[boundary]\nmax_beats = 3\n"),
              HasSubstr("nearest known key is time.max_beats"));
  EXPECT_THAT(refusal(kPassive + "[[region]]\nsegments = [1]\ntension = 0\n"),
              AllOf(HasSubstr("region.1.tension"), HasSubstr("region.tension_factor")));
}

TEST(Parse, KeyWithoutItsUnitIsNamedWithIt) {
  EXPECT_THAT(refusal(kPassive + "[time]\nheart_rate = 60\n"),
              AllOf(HasSubstr("time.heart_rate_bpm"), HasSubstr("the unit is part of the name")));
  EXPECT_THAT(
      refusal("[mesh]\nfile = \"a.vtu\"\n[tissue]\nlaw = \"neo_hookean\"\n[cavities]\npressure_mmHg = 1\n"),
      AllOf(HasSubstr("mesh.length_unit"), HasSubstr("missing"), HasSubstr("\"mm\", \"cm\", \"m\"")));
}

TEST(Parse, WrongTypeNamesLineKeyFoundExpectedAndUnit) {
  EXPECT_EQ(refusal("[mesh]\nshape = \"human_lv\"\n[tissue]\nC_kPa = \"stiff\"\n"),
            "folder/heart.toml:4: tissue.C_kPa: found the text \"stiff\", expected a number in kPa, above 0, "
            "at most 1000 kPa");
  EXPECT_THAT(refusal(kPassive + "[time]\nmax_beats = 2.5\n"),
              AllOf(HasSubstr("2.5"), HasSubstr("a whole number")));
  EXPECT_THAT(refusal(kPassive + "[time]\nmax_beats = 2020-01-01\n"), HasSubstr("a date"));
  EXPECT_THAT(refusal(kPassive + "[output]\ntables = 1\n"), HasSubstr("expected true or false"));
  EXPECT_THAT(refusal(kPassive + "[anatomy]\nanterior_direction = [1, 0]\n"), HasSubstr("three numbers"));
  EXPECT_THAT(refusal(kPassive + "[anatomy]\nanterior_direction = [1, 0, \"x\"]\n"),
              HasSubstr("three numbers"));
  EXPECT_THAT(refusal(kPassive + "[reduction]\nenrichment = [1]\n"), HasSubstr("a list of texts"));
  EXPECT_THAT(refusal("[mesh]\nshape = \"cube\"\n"),
              AllOf(HasSubstr("\"cube\""), HasSubstr("land_ellipsoid")));
  EXPECT_THAT(refusal("mesh = 3\n"), AllOf(HasSubstr("the number 3"), HasSubstr("a table [mesh]")));
  EXPECT_THAT(refusal(kPassive + "[region]\nsegments = [1]\n"), HasSubstr("[[region]]"));
  EXPECT_THAT(refusal("[[mesh]]\nshape = \"human_lv\"\n[[mesh]]\n"), HasSubstr("[mesh]"));
}

TEST(Parse, OutOfRangeNamesRangeAndUnit) {
  const std::string guccione =
      "[mesh]\nshape = \"human_lv\"\n[fibres]\n[cavities]\npressure_mmHg = 1\n[tissue]\n";
  EXPECT_THAT(refusal(guccione + "C_kPa = -2\n"),
              AllOf(HasSubstr("heart.toml:7: tissue.C_kPa: found the number -2"), HasSubstr("above 0")));
  EXPECT_THAT(refusal(guccione + "C_kPa = 0\n"), HasSubstr("above 0"));
  EXPECT_THAT(refusal(guccione + "C_kPa = nan\n"), HasSubstr("number nan"));
  EXPECT_THAT(refusal(guccione + "bulk_modulus_kPa = inf\n"), HasSubstr("number inf"));
  EXPECT_THAT(refusal(guccione + "viscosity_kPa_ms = -1\n"), HasSubstr("at least 0, at most 100000 kPa·ms"));
  EXPECT_THAT(refusal(kPassive + "[time]\nheart_rate_bpm = 5\n"),
              HasSubstr("at least 20, at most 800 1/min"));
  EXPECT_THAT(refusal(kPassive + "[[region]]\nsegments = [1, 30]\n"),
              HasSubstr("each at least 1, at most 29"));
  EXPECT_THAT(refusal(kPassive + "[[region]]\nsegments = [1, 18]\n"),
              HasSubstr("found segment 18, expected at most 17 with the anatomy.scheme aha17"));
  EXPECT_THAT(refusal(kPassive + "[reduction]\nelement_order = 9223372036854775807\n"),
              HasSubstr("at most 2"));
}

TEST(Parse, BrokenTomlNamesLineAndColumn) {
  EXPECT_THAT(refusal("[mesh]\nshape = \n"),
              AllOf(StartsWith("folder/heart.toml:2:"), HasSubstr("not valid TOML")));
  EXPECT_THAT(refusal("[mesh]\nshape = \"human_lv\"\nshape = \"human_lv\"\n"), HasSubstr("heart.toml:3:"));
}

TEST(Parse, MissingRequiredKeys) {
  EXPECT_THAT(refusal("[mesh]\nshape = \"human_lv\"\n[cavities]\n"),
              AllOf(HasSubstr("heart.toml:3: cavities.pressure_mmHg: missing"), HasSubstr("mmHg")));
  EXPECT_THAT(refusal(kPassive + "[[region]]\nname = \"scar\"\n"),
              HasSubstr("heart.toml:7: region.1.segments: missing"));
  EXPECT_THAT(refusal(""), HasSubstr("mesh.shape"));
}

TEST(Load, MissingFileAndWrongExtension) {
  const auto message = [](const std::filesystem::path& file) -> std::string {
    try {
      cardiac::load_protocol(file);
    } catch (const polyaffine::InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_THAT(message("nowhere/heart.toml"), HasSubstr("nowhere/heart.toml: no such file"));
  EXPECT_THAT(message(testing::TempDir()), HasSubstr("no such file"));
  const std::filesystem::path other = std::filesystem::path(testing::TempDir()) / "protocol_parse_test.yaml";
  std::ofstream(other) << kPassive;
  EXPECT_THAT(message(other), AllOf(HasSubstr("\".yaml\""), HasSubstr(".toml")));
  std::filesystem::remove(other);
}

TEST(Load, MeshFileMustExist) {
  EXPECT_NO_THROW(cardiac::check_mesh_file(parsed(kPassive)));
  const auto protocol = parsed(
      "[mesh]\nfile = \"none.vtu\"\nlength_unit = \"mm\"\n[tissue]\nlaw = \"neo_hookean\"\n[cavities]\n"
      "pressure_mmHg = 1\n");
  EXPECT_THROW(cardiac::check_mesh_file(protocol), polyaffine::InputError);
}

TEST(Load, EveryShippedProtocolIsValid) {
  int count = 0;
  for (const auto& file : std::filesystem::directory_iterator(PROJECT_DIR "/protocols")) {
    if (file.path().extension() != ".toml") continue;
    ++count;
    EXPECT_NO_THROW({
      const auto protocol = cardiac::load_protocol(file.path());
      EXPECT_TRUE(protocol.warnings.empty()) << protocol.warnings.front();
    }) << file.path();
  }
  EXPECT_GE(count, 3);
}

}  // namespace
