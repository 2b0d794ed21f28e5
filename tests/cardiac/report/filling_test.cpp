#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <set>

#include <cardiac/report/figures.hpp>
#include <cardiac/report/filling.hpp>
#include <cardiac/report/page.hpp>
#include <cardiac/report/summary.hpp>
#include <cardiac/report/summary_reader.hpp>
#include "cardiac/report/synthetic_result.hpp"

namespace cardiac {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

UnloadingResult unloading() {
  return {"polyaffine",
          6,
          0.018,
          0.004,
          9.5,
          1.5,
          {{"lv", 10, 120, 75, 120.1, {0, 10, 30}, {75, 120.1, 146}},
           {"rv", 5, 130, 100, 130.2, {0, 5, 15}, {100, 130.2, 150}}}};
}

// Klotz et al. 2006: V₀ = V (0.6 − 0.006 P), V₃₀ = V₀ + (V − V₀)/(P/27.78)^(1/2.76); the curve of all
// ventricles, P = 27.78 V_n^2.76, reaches 30 mmHg at 1.028 of the way from V₀ to V₃₀.
TEST(Filling, FollowsKlotz) {
  EXPECT_DOUBLE_EQ(klotz_volume_mL(120, 10, 0), 120 * 0.54);
  EXPECT_DOUBLE_EQ(klotz_volume_mL(120, 10, 10), 120);
  const double V0 = 64.8, V30 = V0 + (120 - V0) / std::pow(10 / 27.78, 1 / 2.76);
  EXPECT_NEAR(klotz_volume_mL(120, 10, 27.78), V30, 1e-9);
}

TEST(Filling, IsATableBesideKlotz) {
  EXPECT_THAT(filling_table(unloading()),
              ::testing::AllOf(HasSubstr("ventricle,pressure_mmHg,volume_mL,klotz_volume_mL\n"),
                               HasSubstr("lv,0,75,64.8\n"), HasSubstr("lv,10,120.1,120\n"),
                               HasSubstr("rv,5,130.2,\n")));
}

// Browsers refuse a drawing in which an element has an attribute twice.
TEST(Filling, NoElementOfAFigureHasAnAttributeTwice) {
  BeatResult r = test::synthetic_biventricle();
  r.unloading = unloading();
  const std::regex element("<[a-z]+( [^>]*)>"), attribute(" ([a-zA-Z:-]+)=\"[^\"]*\"");
  int elements = 0;
  for (const Figure& figure : figures(r, test::synthetic_info()))
    for (std::sregex_iterator e(figure.svg.begin(), figure.svg.end(), element), end; e != end;
         ++e, ++elements) {
      const std::string attributes = (*e)[1];
      std::set<std::string> names;
      for (std::sregex_iterator a(attributes.begin(), attributes.end(), attribute); a != end; ++a)
        EXPECT_TRUE(names.insert((*a)[1]).second) << figure.file << ": " << e->str();
    }
  EXPECT_GT(elements, 1000);
}

TEST(Filling, IsToldByFiguresPageAndSummary) {
  BeatResult r = test::synthetic_biventricle();
  EXPECT_THAT(report_page(r, test::synthetic_info(), "heart", ""), Not(HasSubstr("The unloaded heart")));
  r.unloading = unloading();
  const auto list = figures(r, test::synthetic_info());
  EXPECT_EQ(std::ranges::count(list, "filling.svg", &Figure::file), 1);
  EXPECT_THAT(filling_svg(unloading()), HasSubstr("Klotz et al. 2006"));
  EXPECT_THAT(report_page(r, test::synthetic_info(), "heart", ""),
              ::testing::AllOf(HasSubstr("The unloaded heart"),
                               HasSubstr("imaged at 10.0 mmHg (120.0 mL, free of stress 75.0 mL"),
                               Not(HasSubstr("taken as free of stress (unloaded)"))));
  const auto read = parse_summary(summary_text(r, test::synthetic_info()), "summary.json").result.unloading;
  ASSERT_TRUE(read);
  EXPECT_EQ(read->inflations, 6);
  EXPECT_DOUBLE_EQ(read->distance_mm, 0.018);
  ASSERT_EQ(read->cavities.size(), 2);
  EXPECT_EQ(read->cavities[1].name, "rv");
  EXPECT_EQ(read->cavities[1].volumes_mL, unloading().cavities[1].volumes_mL);
  EXPECT_EQ(filling_svg(*read), filling_svg(unloading()));
}

}  // namespace
}  // namespace cardiac
