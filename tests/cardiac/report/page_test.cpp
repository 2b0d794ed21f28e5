#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include <cardiac/core/csv_reader.hpp>
#include <cardiac/report/page.hpp>
#include <cardiac/report/tables.hpp>
#include "cardiac/report/synthetic_result.hpp"

namespace cardiac {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

std::string page_of(const BeatResult& result) {
  return report_page(result, test::synthetic_info(), "run");
}

TEST(Page, ShowsNumbersFiguresTablesAndPlan) {
  BeatResult r = test::synthetic_beat();
  r.verification = {{"ES", 330, 1.9, 1.1, 0.034, 14.8}};
  const std::string page = page_of(r);
  for (const char* text :
       {"Ejection fraction", ">58.6 <", "−18.4", ">12.6 <", "Pressure–volume loop",
        "Peak longitudinal strain", "Activation time", "basal anteroseptal", "the mesh has one cavity",
        "left out", "0.0340", "6\u202f542 tetra", "0.78", "meshes/healthy_lv.vtu", "name=\"viewport\""})
    EXPECT_THAT(page, HasSubstr(text)) << text;
  EXPECT_THAT(page, Not(HasSubstr("did not complete")));
}

TEST(Page, NeedsNothingBesideItself) {
  const std::string page = page_of(test::synthetic_beat());
  for (const char* text : {"<link", "<script", "src=", "@import", "url("})
    EXPECT_THAT(page, Not(HasSubstr(text)));
}

TEST(Page, EveryFigureHasAText) {
  const std::string page = page_of(test::synthetic_beat());
  int figures = 0;
  for (size_t at = page.find("<svg "); at != std::string::npos; at = page.find("<svg ", at + 1), ++figures)
    EXPECT_NE(page.substr(at, page.find('>', at) - at).find("aria-label=\""), std::string::npos);
  EXPECT_EQ(figures, 10);
}

TEST(Page, EscapesEveryText) {
  const std::string evil = "<script>alert('x')</script>";
  BeatResult r = test::synthetic_beat();
  r.completed = false;
  r.method = r.stop_reason = r.segments[0].name = r.ventricles[0].name = evil;
  r.warnings = {evil};
  r.plan = {{evil, true, evil}};
  r.verification = {{evil, 0, 0, 0, 0, 0}};
  const RunInfo info{evil, "{\"title\": \"" + evil + "\"}", 0};
  const std::string page = report_page(r, info, evil);
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_THAT(page, HasSubstr("&lt;script&gt;alert(&#39;x&#39;)&lt;/script&gt;"));
}

TEST(Page, ShowsWhyARunStoppedBeforeAnythingElse) {
  BeatResult r;
  r.stop_reason = "no convergence at 3 ms";
  r.warnings = {"coarse mesh"};
  const std::string page = page_of(r);
  EXPECT_LT(page.find("did not complete"), page.find("Headline numbers"));
  EXPECT_LT(page.find("no convergence at 3 ms"), page.find("Headline numbers"));
  EXPECT_LT(page.find("coarse mesh"), page.find("Headline numbers"));
}

TEST(Page, SaysInTheLargestLettersThatARunDidNotComplete) {
  BeatResult r = test::synthetic_beat();
  r.completed = false;
  const std::string page = page_of(r);
  EXPECT_THAT(
      page, HasSubstr("<div class=\"alert stop\" role=\"alert\"><strong>This run did not complete</strong>"));
  std::smatch title, stop;
  ASSERT_TRUE(std::regex_search(page, title, std::regex("h1\\{font-size:([0-9.]+)rem")));
  ASSERT_TRUE(std::regex_search(page, stop, std::regex("\\.alert\\.stop strong\\{font-size:([0-9.]+)rem")));
  EXPECT_GT(std::stod(stop[1]), std::stod(title[1]));
}

TEST(Page, SaysWhatKindOfMeanTheGlobalStrainIs) {
  EXPECT_THAT(page_of(test::synthetic_beat()),
              HasSubstr("means of the local strain over the volume of the wall"));
}

TEST(Page, PutsNumbersBesidePublishedOnesWithTheirSource) {
  BeatResult r = test::synthetic_beat();
  r.strain = {-12.3, -25.1, 41.7, 12.6, {-15.1, 0, 0}, {-30.2, 0, 0}, 38.5, 0};
  const std::string page = page_of(r);
  for (const char* text : {"healthy adults 50 to 70", "healthy adults 110 to 130", "−20.1 (−20.9 to −19.3)",
                           "Vo et al. 2018", "2346 people"})
    EXPECT_THAT(page, HasSubstr(text)) << text;
  EXPECT_THAT(page, HasSubstr("<td>−12.3\u00a0%</td><td>−15.1\u00a0%</td><td class=\"left\">weaker</td>"));
  EXPECT_THAT(page, HasSubstr("<td>−25.1\u00a0%</td><td>−30.2\u00a0%</td><td class=\"left\">stronger</td>"));
  EXPECT_THAT(page, HasSubstr("<td>41.7\u00a0%</td><td>38.5\u00a0%</td><td class=\"left\">within</td>"));
  EXPECT_THAT(page, Not(HasSubstr("healthy adults 45 to 65")));
  EXPECT_THAT(page_of(test::synthetic_biventricle()), HasSubstr("healthy adults 45 to 65"));
}

TEST(Page, PutsContoursBesideTheMeans) {
  EXPECT_THAT(page_of(test::synthetic_beat()),
              HasSubstr("<td class=\"left\">Longitudinal, left ventricle</td><td>−18.4</td><td>−21.1</td>"
                        "<td>−18.6</td><td>−15.2</td>"));
}

TEST(Page, OfTwoVentriclesHasTheGlobalStrainOfTheRightOne) {
  BeatResult r = test::synthetic_biventricle();
  r.right_strain = GlobalStrain{-16.2, -18.7, 41.3, NAN, {-20.9, -18, -15}, {NAN, NAN, NAN}, 30.1, 2.5};
  const std::string page = page_of(r);
  EXPECT_THAT(page, HasSubstr("Global strain of the right free wall"));
  EXPECT_THAT(page, HasSubstr(">−16.2 <"));
  EXPECT_THAT(page,
              HasSubstr("<td class=\"left\">Longitudinal, right free wall</td><td>−16.2</td><td>−20.9</td>"));
  EXPECT_THAT(page, HasSubstr("<td>−16.2\u00a0%</td><td>−20.9\u00a0%</td><td class=\"left\">within</td>"));
  EXPECT_THAT(page_of(test::synthetic_beat()), Not(HasSubstr("right free wall")));
}

TEST(Page, TellsWhatWasTakenForGranted) {
  const std::string page = page_of(test::synthetic_beat());
  for (const char* text : {"free of stress", "base is clamped", "long axis runs from the apex", "(0, 1, 0)"})
    EXPECT_THAT(page, HasSubstr(text)) << text;
  EXPECT_THAT(page_of(test::synthetic_biventricle()), Not(HasSubstr("(0, 1, 0)")));
}

TEST(Page, NamesRegionsInPicturesAndTable) {
  RunInfo info = test::synthetic_info();
  info.protocol_json = R"({"region": [{"name": "anterior scar", "segments": [1, 7]}, {"segments": [7]}]})";
  const std::string page = report_page(test::synthetic_beat(true), info, "run");
  EXPECT_THAT(page, HasSubstr(">anterior scar: segments 1, 7</text>"));
  EXPECT_THAT(page, HasSubstr("basal anterior (A)<"));
  EXPECT_THAT(page, HasSubstr("mid anterior (A) (B)<"));
  EXPECT_THAT(page, HasSubstr("(A) anterior scar. (B) region 2."));
}

TEST(Page, SaysThatActivationIsUniformInsteadOfDrawingIt) {
  BeatResult r = test::synthetic_beat();
  for (SegmentInfo& segment : r.segments) segment.activation_ms = 100;
  const std::string page = page_of(r);
  EXPECT_THAT(page, HasSubstr("Every segment is activated at 100 ms."));
  EXPECT_THAT(page, Not(HasSubstr(">Activation time<")));
}

TEST(Page, LeavesAnIndexOpenThatComparesUnlikeThings) {
  // Segment 1 is stretched by 5 % at end systole and shortens by 2 % afterwards.
  BeatResult r = test::synthetic_beat();
  for (Instant& i : r.instants)
    i.strain[0].longitudinal = i.time_ms <= 400 ? 0.05 * std::sin(polyaffine::kPi * i.time_ms / 400)
                                                : -0.02 * std::sin(polyaffine::kPi * (i.time_ms - 400) / 400);
  const std::string page = page_of(r);
  EXPECT_THAT(page, HasSubstr("<td>−2.0</td><td>600</td><td>–</td>"));
  EXPECT_THAT(peaks_table(r), HasSubstr("basal anterior,-0.02,600,"));
  EXPECT_THAT(peaks_table(r), ContainsRegex("1,basal anterior,-0.02,600,[^,]*,[^,]*,,"));
}

TEST(Page, TellsTheCirculationOfAVentricle) {
  BeatResult r = test::synthetic_beat();
  Haemodynamics h;
  h.cardiac_output_L_per_min = 5.3;
  h.arterial_systolic_mmHg = 118, h.arterial_diastolic_mmHg = 71, h.arterial_mean_mmHg = 92;
  r.ventricles[0].haemodynamics = h;
  r.ventricles[0].ed_is = "closure of the mitral valve", r.ventricles[0].es_is = "the smallest volume";
  const std::string page = page_of(r);
  for (const char* text : {"Cardiac output", ">5.3 <", "Aortic pressure", ">118/71 <", "mean 92",
                           "End systole: the smallest volume, at 330 ms"})
    EXPECT_THAT(page, HasSubstr(text)) << text;
}

TEST(Page, ShowsDashesForWhatDoesNotExist) {
  BeatResult r = test::synthetic_beat();
  r.strain.gls_percent = NAN;
  r.ventricles[0].ef_percent = NAN;
  r.simulated_time_s = 0;
  for (Instant& instant : r.instants) instant.strain[5].radial = NAN;
  const std::string page = page_of(r);
  EXPECT_THAT(page, HasSubstr("<td>–</td>"));
  EXPECT_THAT(page, Not(HasSubstr(">nan")));
  EXPECT_THAT(page, Not(HasSubstr("NaN")));
}

TEST(Page, OfALoadingSpeaksOfNoBeat) {
  BeatResult r = test::synthetic_beat();
  r.has_beat = false;
  const std::string page = page_of(r);
  EXPECT_THAT(page, HasSubstr("Prescribed loading"));
  EXPECT_THAT(page, HasSubstr("Volume at the end"));
  for (const char* text : {"Ejection fraction", "PSI", "typical", "healthy adults 90", ">ES<", "Peak strain"})
    EXPECT_THAT(page, Not(HasSubstr(text)));
}

TEST(Page, IsWrittenUnderTheNameOfItsFolder) {
  const test::TemporaryFolder folder;
  write_report_page(test::synthetic_beat(), test::synthetic_info(), folder.path() / "healthy_lv" / "");
  EXPECT_THAT(read_text(folder.path() / "healthy_lv" / "report.html"), HasSubstr("<h1>healthy_lv</h1>"));
}

}  // namespace
}  // namespace cardiac
