#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <set>

#include <cardiac/core/csv_reader.hpp>
#include <cardiac/report/axes.hpp>
#include <cardiac/report/colour_map.hpp>
#include <cardiac/report/figures.hpp>
#include <cardiac/report/pv_loop.hpp>
#include <cardiac/report/strain_curves.hpp>
#include <cardiac/report/text.hpp>
#include <cardiac/report/time_curves.hpp>
#include <cardiac/strain/peaks.hpp>
#include "cardiac/report/synthetic_result.hpp"

namespace cardiac {
namespace {

using ::testing::Contains;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::Not;

long count(const std::string& text, const std::string& what) {
  long n = 0;
  for (size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

std::vector<std::string> files_of(const BeatResult& result) {
  std::vector<std::string> files;
  for (const Figure& figure : figures(result, test::synthetic_info())) files.push_back(figure.file);
  return files;
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
                          "bullseye_peak_longitudinal.svg", "bullseye_peak_circumferential.svg",
                          "bullseye_peak_radial.svg", "bullseye_activation.svg", "strain_curves.svg",
                          "time_curves.svg", "pv_loop.svg"));
  r.ventricles.clear();
  for (SegmentInfo& segment : r.segments) segment.activation_ms.reset();
  EXPECT_THAT(files_of(r),
              ElementsAre("bullseye_longitudinal.svg", "bullseye_circumferential.svg", "bullseye_radial.svg",
                          "bullseye_peak_longitudinal.svg", "bullseye_peak_circumferential.svg",
                          "bullseye_peak_radial.svg", "strain_curves.svg"));
  EXPECT_TRUE(figures(BeatResult{}, RunInfo{}).empty());
}

TEST(Figures, OfTwoVentriclesShowTheRightOneToo) {
  EXPECT_THAT(files_of(test::synthetic_biventricle()),
              IsSupersetOf({"bullseye_longitudinal.svg", "bullseye_right_longitudinal.svg",
                            "bullseye_right_circumferential.svg", "bullseye_right_radial.svg",
                            "strain_curves.svg", "strain_curves_right.svg"}));
}

TEST(Figures, OfALoadingHaveNoPeaks) {
  BeatResult r = test::synthetic_beat();
  r.has_beat = false;
  EXPECT_THAT(files_of(r), Not(Contains(HasSubstr("peak"))));
}

TEST(Figures, MainBullseyeShowsEndSystoleAndThePeakIsNamedAsSuch) {
  // An infarcted segment: +0.25 × 18 % at its peak 60 ms late, less at end systole.
  const BeatResult r = test::synthetic_beat(true);
  const auto peaks = strain_peaks(r.instants, 0, 330);
  const auto svg_of = [list = figures(r, test::synthetic_info())](const std::string& file) {
    return std::ranges::find(list, file, &Figure::file)->svg;
  };
  const auto text = [](double strain) { return ">" + display_text(100 * strain, 1) + "</text>"; };
  ASSERT_NE(text(peaks[6].longitudinal.end_systolic), text(peaks[6].longitudinal.value));
  const std::string main = svg_of("bullseye_longitudinal.svg"),
                    peak = svg_of("bullseye_peak_longitudinal.svg");
  EXPECT_THAT(main, HasSubstr(">End-systolic longitudinal strain</text>"));
  EXPECT_THAT(main, HasSubstr(text(peaks[6].longitudinal.end_systolic)));
  EXPECT_THAT(peak, HasSubstr(">Peak longitudinal strain</text>"));
  EXPECT_THAT(peak, HasSubstr(text(peaks[6].longitudinal.value)));
}

TEST(Figures, UniformActivationHasNoPicture) {
  BeatResult r = test::synthetic_beat();
  for (SegmentInfo& segment : r.segments) segment.activation_ms = 100;
  r.segments[3].activation_ms = 100.4;
  EXPECT_THAT(files_of(r), Not(Contains("bullseye_activation.svg")));
  r.segments[3].activation_ms = 140;
  EXPECT_THAT(files_of(r), Contains("bullseye_activation.svg"));
  ASSERT_TRUE(activation_span(r));
  EXPECT_EQ(activation_span(r)->first_ms, 100);
  EXPECT_EQ(activation_span(r)->last_ms, 140);
  EXPECT_FALSE(activation_span(BeatResult{}));
}

TEST(Figures, ShowEveryCurveAndPhase) {
  const BeatResult r = test::synthetic_beat();
  const std::string curves = strain_curves_svg(r), loop = pv_loop_svg(r);
  EXPECT_EQ(count(curves, "<polyline"), 3 * 17);
  EXPECT_EQ(count(curves, ">ES</text>"), 9);
  for (const char* title : {"Longitudinal", "Circumferential", "Radial"})
    EXPECT_THAT(curves, HasSubstr(">" + std::string(title) + " strain (%)</text>"));
  EXPECT_THAT(curves, HasSubstr("<title>14 apical septal</title>"));
  for (int s = 1; s <= 17; ++s)
    EXPECT_EQ(count(curves, "font-weight=\"bold\">" + std::to_string(s) + "</text>"), 3) << s;
  EXPECT_EQ(count(loop, "<polyline"), 4);
  for (const char* text : {">volume (mL)<", ">pressure (mmHg)<", ">ED<", ">ES<"})
    EXPECT_THAT(loop, HasSubstr(text));
}

TEST(Figures, EveryCurveOfAPanelLooksOfItsOwn) {
  for (const std::string& svg : {strain_curves_svg(test::synthetic_biventricle()),
                                 right_strain_curves_svg(test::synthetic_biventricle())}) {
    // Panels in turn: curves follow each other, the label boxes of a panel come after its curves.
    std::set<std::string> seen;
    size_t curves = 0, at = 0;
    const std::regex line("<polyline [^>]*stroke=\"([^\"]*)\"[^>]*|<rect ");
    for (std::sregex_iterator i(svg.begin(), svg.end(), line), end; i != end; ++i) {
      if (!(*i)[1].matched) {
        EXPECT_EQ(seen.size(), curves);
        seen.clear(), curves = 0;
        continue;
      }
      ++curves, ++at;
      const std::string whole = i->str(), dash = "stroke-dasharray";
      const size_t place = whole.find(dash);
      seen.insert((*i)[1].str() + (place == std::string::npos ? "" : whole.substr(place)));
    }
    EXPECT_GE(at, 36);
  }
}

TEST(Figures, RightVentriclesCurvesAreTwelveAStrain) {
  const std::string curves = right_strain_curves_svg(test::synthetic_biventricle());
  EXPECT_EQ(count(curves, "<polyline"), 3 * 12);
  for (int s = 18; s <= 29; ++s)
    EXPECT_EQ(count(curves, "font-weight=\"bold\">" + std::to_string(s) + "</text>"), 3) << s;
}

TEST(Figures, TimeCurvesMarkEndDiastoleAndEndSystole) {
  const std::string one = time_curves_svg(test::synthetic_beat());
  EXPECT_EQ(count(one, "<polyline"), 2);
  EXPECT_EQ(count(one, "<title>LV ED</title>"), 2);
  EXPECT_EQ(count(one, "<title>LV ES</title>"), 2);
  for (const char* text : {">pressure (mmHg)<", ">volume (mL)<", ">time (ms)<", ">ED<", ">ES<", ">LV<"})
    EXPECT_THAT(one, HasSubstr(text));
  const std::string two = time_curves_svg(test::synthetic_biventricle());
  EXPECT_EQ(count(two, "<polyline"), 4);
  EXPECT_THAT(two, HasSubstr(">RV<"));
  BeatResult loading = test::synthetic_beat();
  loading.has_beat = false;
  EXPECT_THAT(time_curves_svg(loading), Not(HasSubstr(">ES<")));
}

TEST(Figures, TimeCurvesShowTheArteriesOfTheCirculation) {
  BeatResult r = test::synthetic_beat();
  EXPECT_THAT(time_curves_svg(r), Not(HasSubstr(">aorta<")));
  r.circulation = {{"time_ms", "aorta_mmHg", "aortic_valve_mL_per_s"},
                   {{0, 400, 800}, {80, 110, NAN}, {0, 1, 2}}};
  const std::string svg = time_curves_svg(r);
  EXPECT_THAT(svg, HasSubstr(">aorta<"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_EQ(count(svg, "<polyline"), 3);
}

TEST(Figures, ContractionUnderPrescribedLoadsHasAnEndSystole) {
  BeatResult r = test::synthetic_beat();
  r.has_beat = false;
  r.has_contraction = true;
  EXPECT_EQ(count(strain_curves_svg(r), ">ES</text>"), 9);
  EXPECT_THAT(time_curves_svg(r), HasSubstr(">ES<"));
  EXPECT_THAT(files_of(r), Contains("bullseye_peak_longitudinal.svg"));
}

TEST(Figures, EscapeNamesAndNeverShowNaN) {
  BeatResult r = test::synthetic_beat();
  r.segments[2].name = "<script>\"&";
  for (Instant& instant : r.instants) instant.strain[5] = {NAN, NAN, NAN, NAN, NAN, NAN, NAN};
  r.ventricles[0].samples[7].pressure_mmHg = NAN;
  r.ventricles[0].es_time_ms = NAN;
  r.ventricles[0].name = "<script>";
  RunInfo info = test::synthetic_info();
  info.protocol_json = R"({"region": [{"name": "<script>", "segments": [1, 99]}]})";
  for (const Figure& figure : figures(r, info)) {
    EXPECT_THAT(figure.svg, Not(HasSubstr("nan")));
    EXPECT_THAT(figure.svg, Not(HasSubstr("<script>")));
  }
}

TEST(Figures, OfAnEarlierRunWithoutDataNowAreRemoved) {
  const test::TemporaryFolder folder;
  write_figures(test::synthetic_beat(), test::synthetic_info(), folder.path());
  EXPECT_THAT(read_text(folder.path() / "pv_loop.svg"), HasSubstr("</svg>"));
  BeatResult r = test::synthetic_beat();
  r.ventricles.clear();
  write_figures(r, test::synthetic_info(), folder.path());
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "pv_loop.svg"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "strain_curves.svg"));
}

}  // namespace
}  // namespace cardiac
