#include "cardiac/reduction/frame_layout.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include <cardiac/reduction/control_nodes.hpp>
#include <polyaffine/core/error.hpp>

#include "support/land_ellipsoid.hpp"

namespace cardiac {
namespace {

using polyaffine::InputError;
using polyaffine::kPi;
using testing::LandEllipsoid;

FrameLayout layout_of(const RingOptions& rings) {
  const auto& land = LandEllipsoid::get();
  return frame_layout(land.mesh, *land.coordinates, rings);
}

TEST(FrameLayout, FollowsTheSegmentsUnlessSomethingElseIsAskedFor) {
  const auto& land = LandEllipsoid::get();
  const FrameLayout layout = layout_of({});
  EXPECT_TRUE(layout.follows_segments);
  EXPECT_EQ(layout.num_nodes(), kAhaSegments);
  const auto region = region_tets(land.mesh, *land.coordinates, layout);
  const auto segment = segment_tets(land.mesh, *land.coordinates);
  for (int t = 0; t < land.mesh.num_tets(); ++t) ASSERT_EQ(region[t], segment[t] - 1);
  for (int ring = 1; ring <= 3; ++ring) {
    EXPECT_EQ(layout.rings[ring - 1].first_frame, aha_ring_first(ring) - 1);
    for (int j = 0; j < aha_ring_size(ring); ++j)
      EXPECT_EQ(layout.rings[ring - 1].node_angle(j), aha_centre_angle(aha_ring_first(ring) + j));
  }
  EXPECT_FALSE(layout_of({{4, 6, 6}, {}, {0, 0.1, 0}}).follows_segments);
  EXPECT_FALSE(layout_of({{6, 6, 6}}).follows_segments);
}

TEST(FrameLayout, MeasuresTheEllipsoid) {
  const FrameLayout layout = layout_of({});
  EXPECT_GT(layout.rings[0].u, 0.1);
  EXPECT_LT(layout.rings[0].u, layout.rings[1].u);
  EXPECT_LT(layout.rings[1].u, layout.rings[2].u);
  EXPECT_LT(layout.rings[2].u, 0.95);
  // Mid-wall radius at the middle of the thirds, z = −13.3, −6 and 1.3, of semi-axes 8.5 and 18.5; the cells'
  // means differ from it by the spread of radii in them.
  for (const auto& [ring, z] : std::map<int, double>{{0, -13.3}, {1, -6}, {2, 1.3}})
    EXPECT_NEAR(layout.rings[ring].radius, 8.5 * std::sqrt(1 - z * z / (18.5 * 18.5)), 0.8) << ring;
  for (const FrameRing& ring : layout.rings) EXPECT_NEAR(ring.thickness, 3, 0.6);  // 1/|∇t|
  EXPECT_NEAR(layout.cap_thickness, 3, 0.6);
  const double volume = LandEllipsoid::get().mesh.volume();
  EXPECT_NEAR(std::pow(layout.length, 3) * kAhaSegments, volume, 1e-9 * volume);
  EXPECT_NEAR(std::pow(layout_of({{6, 6}}).length, 3) * 13, volume, 1e-9 * volume);
  EXPECT_EQ(layout_of({{4, 6, 6}, {0.2, 0.5, 0.8}}).rings[1].u, 0.5);
}

TEST(FrameLayout, RingsOfOtherLayoutsAreEvenlySpaced) {
  const FrameLayout layout = layout_of({{3, 4, 5, 6}});
  EXPECT_EQ(layout.num_nodes(), 19);
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(layout.rings[k].u, (k + 1) / 4.5, 1e-15);
  EXPECT_EQ(layout.rings[3].first_frame, 0);
  EXPECT_EQ(layout.rings[0].first_frame, 15);
  EXPECT_EQ(layout.cap(), 18);
}

TEST(FrameLayout, RegionsEndHalfWayBetweenNodes) {
  FrameLayout layout;
  layout.rings = {{0.4, 3, 0.5, 4}, {0.8, 4, 0, 0}};
  EXPECT_EQ(layout.region(0.19, 1.0), layout.cap());
  EXPECT_EQ(layout.region(0.21, 0.5), 4);
  EXPECT_EQ(layout.region(0.59, 0.5 + 1.04), 4);  // half of 120° is 1.047
  EXPECT_EQ(layout.region(0.59, 0.5 + 1.05), 5);
  EXPECT_EQ(layout.region(0.59, 0.5 - 1.05), 6);
  EXPECT_EQ(layout.region(0.61, kPi / 4 + 0.01), 1);
  EXPECT_EQ(layout.region(1.01, -kPi / 4 + 0.01), 0);
  EXPECT_EQ(layout.region(1, -kPi / 4 - 0.01), 3);
}

TEST(FrameLayout, EveryRegionOwnsItsNode) {
  const auto& land = LandEllipsoid::get();
  for (const RingOptions& rings :
       {RingOptions{{4}}, RingOptions{{4, 8, 8, 8}}, RingOptions{{6, 6, 6}, {}, {0, 0.5, 0}}}) {
    const FrameLayout layout = layout_of(rings);
    const auto nodes = control_nodes(land.mesh, *land.coordinates, layout);
    ASSERT_EQ(static_cast<int>(nodes.size()), layout.num_nodes());
    for (int i = 0; i < layout.num_nodes(); ++i) {
      const CoordinateSample s = land.coordinates->sample(nodes[i].tet, nodes[i].barycentric);
      EXPECT_EQ(layout.region(s.u, s.psi), i);
    }
    const auto region = region_tets(land.mesh, *land.coordinates, layout);
    EXPECT_EQ(static_cast<int>(std::set<int>(region.begin(), region.end()).size()), layout.num_nodes());
  }
}

TEST(FrameLayout, RefusesWhatMakesNoLayout) {
  for (const RingOptions& bad : {RingOptions{{}}, RingOptions{{2}}, RingOptions{{4, 6, 6}, {0.5, 0.2, 0.8}},
                                 RingOptions{{4, 6, 6}, {0.2, 0.5, 1.0}},
                                 RingOptions{{4, 6}, {0.2, 0.5, 0.8}}, RingOptions{{4, 6}, {}, {0.1}}})
    EXPECT_THROW(layout_of(bad), InputError);
  try {
    layout_of({{60, 60, 60, 60, 60, 60}});
    FAIL() << "a layout finer than the mesh";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("no tet lies in the region of control node"));
  }
}

}  // namespace
}  // namespace cardiac
