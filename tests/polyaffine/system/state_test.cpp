#include "polyaffine/system/state.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace polyaffine {
namespace {

StateLayout layout() {
  StateLayout out;
  out.add({.name = "displacement", .unit = "mm", .solved = Solved::field}, 6);
  out.add({.name = "velocity", .unit = "mm/ms", .solved = Solved::apart}, 6);
  out.add({.name = "volume", .unit = "mm3"}, 1);
  out.add({.name = "pressures", .unit = "kPa"}, 2);
  return out;
}

TEST(StateLayout, BlocksFollowEachOtherAndAreFoundByName) {
  const StateLayout l = layout();
  EXPECT_EQ(l.size(), 15);
  EXPECT_EQ(l.field().first, 0);
  EXPECT_EQ(l.field().size, 6);
  EXPECT_EQ(l.find("pressures").first, 13);
  EXPECT_EQ(l.find("pressures").end(), 15);
  EXPECT_THROW(static_cast<void>(l.find("tension")), std::invalid_argument);
}

TEST(StateLayout, UnknownsLookAtTheirPartOfTheVector) {
  const StateLayout l = layout();
  Vector y = Vector::LinSpaced(15, 0, 14);
  const Unknowns p = l.find("pressures");
  EXPECT_EQ(Vector(p.of(y)), (Vector{{13, 14}}));
  p.of(y).setZero();
  EXPECT_EQ(y[13] + y[14], 0);
  EXPECT_EQ(y[12], 12);
}

TEST(StateLayout, TheFewUnknownsAreNumberedInTheirOrder) {
  const StateLayout l = layout();
  EXPECT_EQ(l.few(), (std::vector<int>{12, 13, 14}));
  EXPECT_EQ(l.few_index(13), 1);
  EXPECT_EQ(l.few_index(3), -1);
}

TEST(StateLayout, ANameTwiceAndALateFieldAreRefused) {
  StateLayout l = layout();
  EXPECT_THROW(l.add({.name = "volume", .unit = "mm3"}, 1), std::invalid_argument);
  EXPECT_THROW(l.add({.name = "field", .unit = "mm", .solved = Solved::field}, 3), std::invalid_argument);
}

}  // namespace
}  // namespace polyaffine
