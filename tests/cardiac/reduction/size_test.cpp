#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cardiac/reduction/discretisation.hpp>
#include <polyaffine/core/error.hpp>

namespace cardiac {
namespace {

std::string refusal(int points, int unknowns, bool sparse) {
  Discretisation d;
  d.points.tet.assign(points, 0);
  d.num_unknowns = unknowns;
  d.sparse = sparse;
  try {
    check_size(d);
  } catch (const polyaffine::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Size, FewerPointsThanASixthOfTheUnknownsAreRefused) {
  EXPECT_EQ(refusal(44, 264, false), "");
  EXPECT_THAT(refusal(43, 264, false),
              testing::HasSubstr("found 43 integration points for 264 unknowns, expected at least"));
  EXPECT_THAT(refusal(43, 264, true), testing::HasSubstr("(44)"));
}

TEST(Size, AReducedModelHasAtMostTwelveThousandUnknowns) {
  EXPECT_EQ(refusal(12000, 12000, false), "");
  EXPECT_THAT(refusal(12000, 12001, false),
              testing::HasSubstr("found 12001 unknowns, expected at most 12000"));
  EXPECT_EQ(refusal(12000, 12001, true), "");
}

}  // namespace
}  // namespace cardiac
