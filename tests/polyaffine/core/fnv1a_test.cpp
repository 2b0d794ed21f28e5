#include "polyaffine/core/fnv1a.hpp"

#include <gtest/gtest.h>

#include <string>

namespace polyaffine {
namespace {

std::uint64_t sum_of(const std::string& text) {
  Fnv1a sum;
  sum.add(std::span(text.data(), text.size()));
  return sum.value();
}

// The vectors of draft-eastlake-fnv, appendix C.
TEST(Fnv1a, OfThePublishedTexts) {
  EXPECT_EQ(sum_of(""), 0xcbf29ce484222325U);
  EXPECT_EQ(sum_of("a"), 0xaf63dc4c8601ec8cU);
  EXPECT_EQ(sum_of("foobar"), 0x85944171f73967e8U);
}

TEST(Fnv1a, GoesOnFromOnePieceToTheNext) {
  Fnv1a sum;
  for (const std::string piece : {"foo", "bar"}) sum.add(std::span(piece.data(), piece.size()));
  EXPECT_EQ(sum.value(), sum_of("foobar"));
}

}  // namespace
}  // namespace polyaffine
