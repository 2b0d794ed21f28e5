#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cardiac/anatomy/segments.hpp>
#include <cardiac/report/segment_picture.hpp>
#include <set>

namespace cardiac {
namespace {

TEST(SegmentPicture, SegmentsHaveColoursOfTheirOwn) {
  std::set<std::string> seen;
  for (int s = 1; s <= kBothSegments; ++s) seen.insert(segment_colour(s).hex());
  EXPECT_EQ(seen.size(), kBothSegments);
}

}  // namespace
}  // namespace cardiac
