#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <cardiac/report/axes.hpp>
#include <cardiac/report/bullseye.hpp>
#include <cardiac/report/colour_map.hpp>
#include <cardiac/report/csv_reader.hpp>
#include <cardiac/report/figures.hpp>
#include <cardiac/report/pv_loop.hpp>
#include <cardiac/report/strain_curves.hpp>
#include "cardiac/report/synthetic_result.hpp"

namespace cardiac {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

long count(const std::string& text, const std::string& what) {
  long n = 0;
  for (size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

std::vector<std::string> files_of(const BeatResult& result) {
  std::vector<std::string> files;
  for (const Figure& figure : figures(result)) files.push_back(figure.file);
  return files;
}

TEST(Bullseye, LiesAsInTheStandard) {
  const auto direction = [](int segment) {
    const DrawPoint c = bullseye_cell(segment).centre();
    return std::atan2(c.y, c.x) * 180 / polyaffine::kPi;
  };
  for (const int anterior : {1, 7, 13}) EXPECT_NEAR(direction(anterior), 90, 1e-9);
  for (const int inferior : {4, 10, 15}) EXPECT_NEAR(direction(inferior), -90, 1e-9);
  EXPECT_NEAR(direction(2), 150, 1e-9);             // anteroseptal: upper left
  EXPECT_NEAR(direction(3), -150, 1e-9);            // inferoseptal: lower left
  EXPECT_NEAR(std::abs(direction(14)), 180, 1e-9);  // septal: left
  EXPECT_NEAR(direction(16), 0, 1e-9);              // lateral: right
  EXPECT_NEAR(direction(5), -30, 1e-9);
  EXPECT_NEAR(direction(6), 30, 1e-9);
  EXPECT_EQ(bullseye_cell(17).centre().x, 0);
  EXPECT_EQ(bullseye_cell(17).centre().y, 0);
  EXPECT_THROW(bullseye_cell(18), std::out_of_range);
}

TEST(Bullseye, CellsTileTheDisc) {
  double area = 0;
  for (int segment = 1; segment <= 17; ++segment) {
    const BullseyeCell c = bullseye_cell(segment);
    area += (c.outer * c.outer - c.inner * c.inner) * (c.to_deg - c.from_deg) / 360;
  }
  EXPECT_NEAR(area, 1, 1e-14);  // of the unit disc, in round-off
}

TEST(Bullseye, ShowsEverySegmentWithItsValueAndGreyWhereThereIsNone) {
  Bullseye bullseye{"Peak", "%", ColourScale::diverging, "", "", 1, {}};
  for (size_t i = 0; i < 16; ++i) bullseye.values[i] = -static_cast<double>(i) - 0.5;
  bullseye.values[3] = std::numeric_limits<double>::quiet_NaN();
  const std::string svg = bullseye_svg(bullseye);
  for (int i = 1; i <= 17; ++i) EXPECT_THAT(svg, HasSubstr(">" + std::to_string(i) + "</text>"));
  EXPECT_THAT(svg, HasSubstr(">−15.5</text>"));
  EXPECT_EQ(count(svg, "fill=\"#e0e0e0\""), 2);
  EXPECT_EQ(count(svg, ">–</text>"), 2);
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

TEST(Colours, DivergeFromWhiteAndCarryReadableText) {
  EXPECT_EQ(diverging_colour(0).hex(), "#f7f7f7");
  EXPECT_GT(diverging_colour(-0.6).blue, diverging_colour(-0.6).red);
  EXPECT_GT(diverging_colour(0.6).red, diverging_colour(0.6).blue);
  EXPECT_EQ(diverging_colour(-7).hex(), diverging_colour(-1).hex());
  EXPECT_EQ(diverging_colour(-1).readable_text(), "#ffffff");
  EXPECT_EQ(diverging_colour(0).readable_text(), "#1a1a1a");
  EXPECT_EQ(sequential_colour(0).hex(), "#440154");
  EXPECT_EQ(sequential_colour(1).hex(), "#fde725");
}

TEST(Axes, HaveRoundTicks) {
  const Axis axis = round_axis(-18.3, 4.2, 5);
  EXPECT_EQ(axis.low, -20);
  EXPECT_EQ(axis.high, 5);
  EXPECT_THAT(axis.ticks(), ElementsAre(-20, -15, -10, -5, 0, 5));
  EXPECT_EQ(axis.label(-15), "−15");
  EXPECT_EQ(round_axis(0, 0.23, 5).label(0.1), "0.10");
  EXPECT_THAT(tight_axis(3, 23, 4).ticks(), ElementsAre(5, 10, 15, 20));
}

TEST(Axes, CanBeLogarithmic) {
  const Axis wide = log_axis(0.02, 60);
  EXPECT_TRUE(wide.logarithmic);
  EXPECT_DOUBLE_EQ(wide.low, 0.01);
  EXPECT_DOUBLE_EQ(wide.high, 100);
  EXPECT_THAT(wide.ticks(), ElementsAre(DoubleNear(0.01, 1e-12), DoubleNear(0.1, 1e-12), DoubleNear(1, 1e-12),
                                        DoubleNear(10, 1e-12), DoubleNear(100, 1e-12)));
  EXPECT_NEAR(wide.fraction(1), 0.5, 1e-12);
  EXPECT_EQ(wide.label(wide.ticks()[0]), "0.01");
  EXPECT_EQ(wide.label(wide.ticks()[3]), "10");
  const Axis narrow = log_axis(1.3, 8);
  EXPECT_THAT(narrow.ticks(), ElementsAre(DoubleNear(1, 1e-12), DoubleNear(2, 1e-12), DoubleNear(5, 1e-12),
                                          DoubleNear(10, 1e-12)));
  for (const Axis& axis : {log_axis(0, 1), log_axis(INFINITY, 0), log_axis(3, 3)})
    EXPECT_TRUE(axis.low > 0 && axis.high > axis.low && std::isfinite(axis.high));
}

TEST(Axes, CanBeDrawnForNothingAndForAConstant) {
  for (const Axis& axis : {round_axis(0, 0, 5), round_axis(7, 7, 5), round_axis(INFINITY, -INFINITY, 5),
                           round_axis(1e9, 1e9, 5)}) {
    EXPECT_TRUE(std::isfinite(axis.low) && axis.high > axis.low && axis.step > 0);
    EXPECT_GE(axis.ticks().size(), 2);
    EXPECT_LE(axis.ticks().size(), 20);
  }
}

TEST(Figures, AreThoseThatTheResultHasDataFor) {
  BeatResult r = test::synthetic_beat();
  EXPECT_THAT(files_of(r),
              ElementsAre("bullseye_longitudinal.svg", "bullseye_circumferential.svg", "bullseye_radial.svg",
                          "bullseye_activation.svg", "strain_curves.svg", "pv_loop.svg"));
  for (SegmentInfo& segment : r.segments) segment.activation_ms.reset();
  r.ventricles.clear();
  EXPECT_THAT(files_of(r), ElementsAre("bullseye_longitudinal.svg", "bullseye_circumferential.svg",
                                       "bullseye_radial.svg", "strain_curves.svg"));
  EXPECT_TRUE(figures(BeatResult{}).empty());
}

TEST(Figures, ShowEveryCurveAndPhase) {
  const BeatResult r = test::synthetic_beat();
  const std::string curves = strain_curves_svg(r), loop = pv_loop_svg(r);
  EXPECT_EQ(count(curves, "<polyline"), 3 * 17);
  EXPECT_EQ(count(curves, ">ES</text>"), 3);
  EXPECT_THAT(curves, HasSubstr(">strain (%)</text>"));
  EXPECT_THAT(curves, HasSubstr("<title>14 apical septal</title>"));
  EXPECT_EQ(count(loop, "<polyline"), 4);
  for (const char* text : {">volume (mL)<", ">pressure (mmHg)<", ">ED<", ">ES<"})
    EXPECT_THAT(loop, HasSubstr(text));
}

TEST(Figures, EscapeNamesAndNeverShowNaN) {
  BeatResult r = test::synthetic_beat();
  r.segments[2].name = "<script>\"&";
  for (Instant& instant : r.instants) instant.strain[5] = {NAN, NAN, NAN, NAN, NAN, NAN, NAN};
  r.ventricles[0].samples[7].pressure_mmHg = NAN;
  r.ventricles[0].es_time_ms = NAN;
  for (const Figure& figure : figures(r)) {
    EXPECT_THAT(figure.svg, Not(HasSubstr("nan")));
    EXPECT_THAT(figure.svg, Not(HasSubstr("<script>")));
  }
}

TEST(Figures, OfAnEarlierRunWithoutDataNowAreRemoved) {
  const test::TemporaryFolder folder;
  write_figures(test::synthetic_beat(), folder.path());
  EXPECT_THAT(read_text(folder.path() / "pv_loop.svg"), HasSubstr("</svg>"));
  BeatResult r = test::synthetic_beat();
  r.ventricles.clear();
  write_figures(r, folder.path());
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "pv_loop.svg"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "strain_curves.svg"));
}

}  // namespace
}  // namespace cardiac
