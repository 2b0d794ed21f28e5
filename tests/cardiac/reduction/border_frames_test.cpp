#include "cardiac/reduction/border_frames.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "support/aha_frames.hpp"
#include "support/land_ellipsoid.hpp"

namespace cardiac {
namespace {

using polyaffine::FrameSample;
using polyaffine::Vec3;
using polyaffine::Vec4;
using testing::aha_frames;
using testing::LandEllipsoid;

BorderFrames with_borders(const std::vector<int>& weak) {
  return {aha_frames(), testing::kinds_of(weak)};
}

TEST(BorderFrames, OneForEveryBorderAndCorner) {
  const int plain = aha_frames()->num_frames();
  EXPECT_EQ(with_borders({}).num_frames(), plain);
  // 7 and 8: borders to 12 and 9; up to 1 and 2; down from 7 and 8; two corners above and, of the six
  // sectors that the borders of ring 2 tell, two below.
  EXPECT_EQ(with_borders({7, 8}).num_frames() - plain, 10);
  EXPECT_EQ(with_borders({1}).num_frames() - plain, 2 + 1 + 2);         // nothing above the base
  EXPECT_EQ(with_borders({1, 2, 3, 4, 5, 6}).num_frames() - plain, 6);  // straight around: no corner
  EXPECT_EQ(with_borders({17}).num_frames() - plain, 4);
}

TEST(BorderFrames, LeavesTheFramesAsTheyAreAndEndsAtTheNodes) {
  const auto plain = aha_frames();
  const BorderFrames frames = with_borders({7, 8});
  std::map<int, double> largest;
  for (int t = 0; t < LandEllipsoid::get().mesh.num_tets(); ++t) {
    const Vec4 l(0.4, 0.3, 0.2, 0.1);
    const auto own = plain->sample(t, l).frames;
    const auto all = frames.sample(t, l).frames;
    ASSERT_GE(all.size(), own.size());
    for (std::size_t i = 0; i < own.size(); ++i) EXPECT_EQ(all[i].weight, own[i].weight);
    const CoordinateSample at = plain->coordinates().sample(t, l);
    for (std::size_t i = own.size(); i < all.size(); ++i) {
      EXPECT_GE(all[i].frame, plain->num_frames());
      EXPECT_GT(all[i].weight, 0);
      EXPECT_LE(all[i].weight, 1);
      EXPECT_GT(at.u, 0.2);  // the rings of nodes below and
      EXPECT_LT(at.u, 1);    // the base above segments 7 and 8
      largest[all[i].frame] = std::max(largest[all[i].frame], all[i].weight);
    }
  }
  EXPECT_EQ(largest.size(), 10U);
  for (const auto& [frame, weight] : largest) EXPECT_GT(weight, 0.6) << frame;
}

TEST(BorderFrames, GradientsMatchFiniteDifferences) {
  const BorderFrames frames = with_borders({7, 8, 13});
  const int first = aha_frames()->num_frames();
  const auto& c = *LandEllipsoid::get().coordinates;
  constexpr double kStep = 1e-5;
  const auto borders = [&](int t, const Vec4& l) {
    std::map<int, FrameSample> out;
    for (const FrameSample& f : frames.sample(t, l).frames)
      if (f.frame >= first) out[f.frame] = f;
    return out;
  };
  int compared = 0;
  double steepest = 0;
  for (int t = 0; t < LandEllipsoid::get().mesh.num_tets(); ++t) {
    const Vec4 l(0.3, 0.3, 0.25, 0.15);
    if (c.position(t, l).head<2>().norm() < 1) continue;  // the angle varies too fast for the step
    for (int k = 1; k < 4; ++k) {
      const Vec4 d = kStep * (Vec4::Unit(k) - Vec4::Unit(0));
      auto ahead = borders(t, l + d), back = borders(t, l - d);
      const Vec3 dX = c.position(t, l + d) - c.position(t, l - d);
      for (const auto& [frame, f] : borders(t, l)) {
        if (!ahead.contains(frame) || !back.contains(frame)) continue;  // a kink lies between
        ++compared;
        // Rounding of the differences, 1e-15, and third order in the step.
        EXPECT_NEAR(ahead[frame].weight - back[frame].weight, f.weight_gradient.dot(dX), 1e-12);
        steepest = std::max(steepest, f.weight_gradient.norm());
      }
    }
  }
  EXPECT_GT(compared, 300);
  EXPECT_GT(steepest, 0.05);
}

}  // namespace
}  // namespace cardiac
