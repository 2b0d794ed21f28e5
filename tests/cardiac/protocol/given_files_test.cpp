#include <array>
#include <cardiac/activation/activation.hpp>
#include <cardiac/core/given_curve.hpp>
#include <cardiac/core/units.hpp>
#include <fstream>

#include "texts.hpp"

namespace cardiac {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::string file(const std::string& name, const std::string& text) {
  const std::string path = ::testing::TempDir() + name;
  std::ofstream(path) << text;
  return path;
}

std::string cavities(const std::string& key, const std::string& path) {
  return "[mesh]\nshape = \"human_lv\"\n[tissue]\nlaw = "
         "\"neo_hookean\"\n[fibres]\n[activation]\n[contraction]\n"
         "[cavities]\n" +
         key + " = \"" + path + "\"\n[time]\nduration_ms = 1600\n";
}

// As cavity.csv has them, with a column that is not looked at.
const std::string kPressures =
    "time_ms,ventricle,volume_mL,pressure_mmHg,phase\n0,lv,100,10,filling\n300,lv,60,120,ejection\n800,lv,"
    "100,10,filling\n";

TEST(GivenFiles, PressuresOfACavityTableRepeat) {
  const Protocol protocol = parsed(cavities("pressure_file", file("p.csv", kPressures)));
  ASSERT_TRUE(protocol.cavities->curves);
  EXPECT_FALSE(protocol.cavities->curves->are_volumes);
  const GivenCurve& curve = protocol.cavities->curves->curves.at(0);
  EXPECT_TRUE(curve.repeats);
  EXPECT_NEAR(curve.at(1100).first, 120 * kPa_per_mmHg, 1e-12);
  EXPECT_TRUE(protocol.warnings.empty()) << protocol.warnings.front();
}

TEST(GivenFiles, VolumesAndSecondsAreReadToo) {
  const Protocol protocol =
      parsed(cavities("volume_file", file("v.csv", "time_s,volume_mL\n0,100\n0.4,50\n0.8,100\n1.6,90\n")));
  const GivenCurve& curve = protocol.cavities->curves->curves.at(0);
  EXPECT_TRUE(protocol.cavities->curves->are_volumes);
  EXPECT_FALSE(curve.repeats);  // as long as the run
  EXPECT_NEAR(curve.at(400).first, 50000, 1e-9);
  EXPECT_NEAR(curve.at(1600).first, 90000, 1e-9);
}

TEST(GivenFiles, ErrorsNameFileLineColumnFoundAndExpected) {
  const auto refused = [](const std::string& text, const std::string& key = "pressure_file",
                          const std::vector<std::string>& overrides = {}) {
    return refusal(cavities(key, file("bad.csv", text)), overrides);
  };
  EXPECT_THAT(refused("time_ms,ventricle,pressure\n0,lv,1\n"),
              AllOf(HasSubstr("bad.csv:1: found the columns time_ms, ventricle, pressure"),
                    HasSubstr("expected one named pressure_mmHg or pressure_kPa")));
  EXPECT_THAT(refused("time_ms,ventricle,pressure_mmHg\n0,lv,1\n1,lv,high\n"),
              AllOf(HasSubstr("bad.csv:3, column 'pressure_mmHg': found 'high'"), HasSubstr("a number")));
  EXPECT_THAT(refused("time_ms,ventricle,pressure_mmHg\n0,lv,1\n9,lv,1\n9,lv,2\n"),
              AllOf(HasSubstr("bad.csv:4, column 'time_ms': found '9'"),
                    HasSubstr("more than the row before it, 9")));
  EXPECT_THAT(refused("time_ms,ventricle,pressure_mmHg\n0,left,1\n"),
              HasSubstr("column 'ventricle': found 'left', expected lv or rv"));
  EXPECT_THAT(refused("time_ms,volume_mL\n0,-3\n", "volume_file"), HasSubstr("expected a volume above 0 mL"));
  EXPECT_THAT(refused("time_ms,pressure_mmHg\n0,3\n"), HasSubstr("found 1 rows, expected at least two"));
  EXPECT_THAT(refused("time_ms,pressure_mmHg\n0,3\n250,9\n500,3\n"),
              AllOf(HasSubstr("found rows from 0 to 500 ms"), HasSubstr("800")));
  EXPECT_THAT(
      refused("time_ms,pressure_mmHg\n0,3\n600,9\n1200,3\n"),
      AllOf(HasSubstr("found rows from 0 to 1200 ms, expected all of 0 to 1600 ms (time.duration_ms)"),
            HasSubstr("or one beat of 800 ms")));
  EXPECT_THAT(refusal(cavities("pressure_file", "nowhere.csv")),
              HasSubstr("no such file folder/nowhere.csv"));
  EXPECT_THAT(refused(kPressures, "pressure_file", {"cavities.volume_file=/tmp/v.csv"}),
              HasSubstr("found beside cavities.pressure_file"));
}

TEST(GivenFiles, AKeySaysWhetherTheTableRepeats) {
  const std::string text = cavities("pressure_file", file("p.csv", kPressures));
  EXPECT_THAT(refusal(text, {"cavities.repeats=no"}), HasSubstr("expected all of 0 to 1600 ms"));
  const Protocol whole = parsed(text, {"cavities.repeats=no", "time.duration_ms=800"});
  EXPECT_FALSE(whole.cavities->curves->curves.at(0).repeats);
}

TEST(GivenFiles, TensionIsACurveFromTheExcitationOn) {
  const std::string beat =
      "[mesh]\nshape = \"human_lv\"\n[fibres]\n[activation]\n[contraction]\nmodel = \"table\"\n";
  const std::string path = file("tension.csv", "time_ms,tension_kPa\n0,0\n150,80\n400,0\n800,0\n");
  const Protocol protocol = parsed(beat + "tension_file = \"" + path + "\"\n[circulation]\n");
  ASSERT_TRUE(protocol.contraction->tension);
  EXPECT_NEAR(protocol.contraction->tension->at(150).first, 80, 1e-12);
  EXPECT_NEAR(protocol.contraction->tension->at(950).first, 80, 1e-12);
  EXPECT_THAT(refusal(beat + "[circulation]\n"), HasSubstr("contraction.tension_file: missing"));
  const std::string wrong = file("tension2.csv", "time_ms,tension_kPa\n0,-1\n800,0\n");
  EXPECT_THAT(
      refusal(beat + "tension_file = \"" + wrong + "\"\n[circulation]\n"),
      HasSubstr("tension2.csv:2, column 'tension_kPa': found '-1', expected a tension of 0 to 2000 kPa"));
}

TEST(GivenFiles, ActivationTimesOfPoints) {
  const std::string beat = "[mesh]\nshape = \"human_lv\"\n[fibres]\n[activation]\nmode = \"table\"\n";
  const std::string path = file("times.csv", "x_cm,y_cm,z_cm,activation_ms\n1,2,3,40\n-1,0,2,55\n");
  const Protocol protocol = parsed(beat + "times_file = \"" + path + "\"\n[contraction]\n[circulation]\n");
  ASSERT_TRUE(protocol.activation->map);
  EXPECT_EQ(protocol.activation->map->points.cols(), 2);
  EXPECT_EQ(protocol.activation->map->points(1, 0), 20);
  EXPECT_EQ(protocol.activation->map->times_ms[1], 55);
  EXPECT_THAT(refusal(beat + "[contraction]\n[circulation]\n"), HasSubstr("activation.times_file: missing"));
  EXPECT_THAT(refusal(beat + "times_file = \"" + file("t2.csv", "x_mm,y_mm,activation_ms\n") +
                      "\"\n[contraction]\n[circulation]\n"),
              AllOf(HasSubstr("t2.csv:1: found the columns x_mm, y_mm, activation_ms"), HasSubstr("z_mm")));
}

}  // namespace
}  // namespace cardiac
