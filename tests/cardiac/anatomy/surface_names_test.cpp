#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cardiac/anatomy/idealised.hpp>
#include <cardiac/anatomy/surface_names.hpp>
#include <polyaffine/core/error.hpp>

#include "support/error_of.hpp"

namespace cardiac {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using Map = std::map<int, int>;

TEST(SurfaceNames, OfCommonTools) {
  for (const char* name : {"endo", "ENDO", "lv_endo", "ENDO_LV", "Endocardium", "endocardium LV", "LV",
                           "lvendo", "left_endo", "inner"})
    EXPECT_EQ(surface_of_name(name), kEndocardium) << name;
  for (const char* name : {"rv_endo", "ENDO_RV", "RV", "Endocardium RV", "right-endo", "rv_septum_endo"})
    EXPECT_EQ(surface_of_name(name), kRvEndocardium) << name;
  for (const char* name : {"epi", "EPI", "Epicardium", "lv_epi", "epi_rv", "outer"})
    EXPECT_EQ(surface_of_name(name), kEpicardium) << name;
  for (const char* name : {"base", "BASE", "Base LV", "top", "mitral valve", "MV", "pulmonary_valve"})
    EXPECT_EQ(surface_of_name(name), kBase) << name;
  for (const char* name : {"myocardium", "volume", "", "stop", "wall 3"})
    EXPECT_FALSE(surface_of_name(name)) << name;
}

TEST(SurfaceNames, NumbersNamesAndWhatTheUserSays) {
  EXPECT_EQ(heart_labels({1, 2, 3}, {}, {}), (Map{{1, 1}, {2, 2}, {3, 3}}));
  EXPECT_EQ(heart_labels({1, 2, 3, 4, 9}, {}, {}), (Map{{1, 1}, {2, 2}, {3, 3}, {4, 4}}));
  EXPECT_EQ(heart_labels({1, 2, 3}, {{1, "EPI"}, {2, "ENDO"}, {3, "BASE"}}, {}),
            (Map{{1, 2}, {2, 1}, {3, 3}}));
  EXPECT_EQ(heart_labels({10, 20, 30, 40}, {}, {.endo = {30}, .epi = {40}, .base = {10}, .rv_endo = {20}}),
            (Map{{30, 1}, {40, 2}, {10, 3}, {20, 4}}));
  EXPECT_EQ(
      heart_labels({5, 6, 7, 8}, {{5, "a"}, {6, "b"}, {7, "c"}, {8, "MV"}}, {.endo = {"a"}, .epi = {"b", 7}}),
      (Map{{5, 1}, {6, 2}, {7, 2}, {8, 3}}));
  EXPECT_TRUE(heart_labels({10, 20}, {}, {}).empty()) << "nothing known: the shape decides";
  EXPECT_TRUE(heart_labels({}, {}, {}).empty());
}

std::string refusal(const std::set<int>& numbers, const std::map<int, std::string>& names,
                    const SurfaceLabelMap& map) {
  return polyaffine::testing::error_of([&] { heart_labels(numbers, names, map); });
}

TEST(SurfaceNames, RefusalsListWhatTheFileHas) {
  EXPECT_THAT(refusal({1, 2, 9}, {}, {}),
              AllOf(HasSubstr("label 3"), HasSubstr("\"base\""), HasSubstr("labels found: 1, 2, 9")));
  EXPECT_THAT(refusal({1, 2}, {{1, "endo"}, {2, "epi"}}, {}),
              AllOf(HasSubstr("\"base\""), HasSubstr("1 \"endo\", 2 \"epi\"")));
  EXPECT_THAT(refusal({1, 2, 3}, {}, {.epi = {8}}), AllOf(HasSubstr("label 8"), HasSubstr("epi_label")));
  EXPECT_THAT(refusal({1, 2, 3}, {}, {.base = {"lid"}}), HasSubstr("label \"lid\""));
  EXPECT_THAT(refusal({1, 2, 3}, {}, {.endo = {1}, .epi = {1}}), HasSubstr("for two surfaces"));
  EXPECT_THAT(refusal({}, {}, {.endo = {1}}), HasSubstr("labels found: none"));
}

}  // namespace
}  // namespace cardiac
