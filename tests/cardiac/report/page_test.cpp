#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include <cardiac/report/csv_reader.hpp>
#include <cardiac/report/page.hpp>
#include "cardiac/report/synthetic_result.hpp"

namespace cardiac {
namespace {

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
  EXPECT_EQ(figures, 6);
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
  for (const char* text : {"Ejection fraction", "PSI", "typical", ">ES<"})
    EXPECT_THAT(page, Not(HasSubstr(text)));
}

TEST(Page, IsWrittenUnderTheNameOfItsFolder) {
  const test::TemporaryFolder folder;
  write_report_page(test::synthetic_beat(), test::synthetic_info(), folder.path() / "healthy_lv" / "");
  EXPECT_THAT(read_text(folder.path() / "healthy_lv" / "report.html"), HasSubstr("<h1>healthy_lv</h1>"));
}

}  // namespace
}  // namespace cardiac
