#include "cardiac/reduction/segment_cells.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "support/aha_frames.hpp"
#include "support/land_ellipsoid.hpp"

namespace cardiac {
namespace {

using polyaffine::CellPlace;
using polyaffine::Vec3;
using polyaffine::Vec4;
using testing::aha_frames;
using testing::LandEllipsoid;

TEST(SegmentCells, AreThoseOfTheFramesWhereNoSegmentDiffers) {
  const auto frames = aha_frames();
  const SegmentCells cells(frames, testing::kinds_of({}));
  std::set<int> seen;
  for (int t = 0; t < LandEllipsoid::get().mesh.num_tets(); ++t) {
    const auto whole = frames->point_cell(t, Vec4::Constant(0.25));
    const CellPlace at = cells(t, Vec4::Constant(0.25));
    EXPECT_EQ(at.cell, whole.index);
    EXPECT_EQ(at.place, whole.place);
    EXPECT_EQ(cells.at_apex(at.cell), frames->coordinates().sample(t, Vec4::Constant(0.25)).u <= 0.2);
    seen.insert(at.cell);
  }
  EXPECT_EQ(static_cast<int>(seen.size()), frames->num_cells());
}

class Divided : public ::testing::TestWithParam<std::vector<int>> {};

TEST_P(Divided, PartsLieInOneSegmentWithPlacesFromBorderToBorder) {
  const auto frames = aha_frames();
  const auto kind = testing::kinds_of(GetParam());
  const SegmentCells cells(frames, kind);
  const auto points = frames->coordinates().space().wall_points(4);
  std::map<int, std::set<int>> kinds_of, wholes_of;
  Vec3 low = Vec3::Ones(), high = Vec3::Zero();
  for (std::size_t q = 0; q < points.tet.size(); ++q) {
    const Vec4 l = points.barycentric.col(static_cast<Eigen::Index>(q));
    const CellPlace at = cells(points.tet[q], l);
    const Vec3 X = frames->coordinates().position(points.tet[q], l);
    kinds_of[at.cell].insert(kind[segment_at(frames->coordinates(), points.tet[q], l, X) - 1]);
    wholes_of[at.cell].insert(frames->point_cell(points.tet[q], l).index);
    low = low.cwiseMin(at.place);
    high = high.cwiseMax(at.place);
  }
  EXPECT_GT(static_cast<int>(kinds_of.size()), frames->num_cells() + 4);
  for (const auto& [cell, found] : kinds_of) EXPECT_EQ(found.size(), 1U) << cell;
  for (const auto& [cell, found] : wholes_of) EXPECT_EQ(found.size(), 1U) << cell;
  // The depth of quadratic elements passes 0 and 1 by a little, the rest ends at borders.
  EXPECT_GE(low.minCoeff(), -0.02);
  EXPECT_LE(high.maxCoeff(), 1.02);
  EXPECT_LT(low.maxCoeff(), 0.05);
  EXPECT_GT(high.minCoeff(), 0.95);
}

INSTANTIATE_TEST_SUITE_P(SegmentCells, Divided,
                         ::testing::Values(std::vector<int>{7, 8}, std::vector<int>{13}, std::vector<int>{17},
                                           std::vector<int>{1, 3, 10, 12}));

// Within a part the place varies smoothly: a step of the point moves it in proportion.
TEST(SegmentCells, PlacesAreSmoothWithinAPart) {
  const auto frames = aha_frames();
  const SegmentCells cells(frames, testing::kinds_of({7, 8}));
  int compared = 0;
  for (int t = 0; t < LandEllipsoid::get().mesh.num_tets(); ++t) {
    const Vec4 l = Vec4::Constant(0.25), d = 1e-4 * (Vec4::Unit(1) - Vec4::Unit(0));
    const CellPlace before = cells(t, l - d), at = cells(t, l), after = cells(t, l + d);
    if (before.cell != at.cell || after.cell != at.cell || cells.at_apex(at.cell)) continue;
    EXPECT_LT((before.place + after.place - 2 * at.place).norm(), 1e-5) << t;  // d² times a curvature of 100
    EXPECT_GT((after.place - before.place).norm(), 1e-6);
    ++compared;
  }
  EXPECT_GT(compared, 100);
}

}  // namespace
}  // namespace cardiac
