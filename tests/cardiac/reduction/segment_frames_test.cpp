#include "cardiac/reduction/segment_frames.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

#include "support/land_ellipsoid.hpp"

namespace cardiac {
namespace {

using polyaffine::FrameSample;
using polyaffine::FramesAtPoint;
using polyaffine::kPi;
using polyaffine::Mat3;
using polyaffine::Vec3;
using polyaffine::Vec4;
using testing::LandEllipsoid;

SegmentFrames make_frames(bool base_frames, const RingOptions& rings = {}) {
  const auto& land = LandEllipsoid::get();
  return {land.coordinates, frame_layout(land.mesh, *land.coordinates, rings), base_frames};
}

/// 17, 5, 9, 29 and 61 control nodes; rings turned against each other.
const std::vector<RingOptions> kLayouts{
    {}, {{4}}, {{3, 5}, {}, {0, 0.4}}, {{4, 8, 8, 8}}, {{12, 12, 12, 12, 12}, {}, {0, 0.2, 0, 0.2, 0}}};

std::map<int, FrameSample> by_frame(const FramesAtPoint& at) {
  std::map<int, FrameSample> out;
  for (const FrameSample& f : at.frames) {
    EXPECT_FALSE(out.contains(f.frame)) << "frame given twice";
    out[f.frame] = f;
  }
  return out;
}

class Frames : public ::testing::TestWithParam<std::tuple<int, bool>> {
 protected:
  const RingOptions& rings() const { return kLayouts[std::get<0>(GetParam())]; }
  bool base_frames() const { return std::get<1>(GetParam()); }
  SegmentFrames frames_of_case() const { return make_frames(base_frames(), rings()); }
};

TEST_P(Frames, WeightsAreAPartitionOfUnity) {
  const SegmentFrames frames = frames_of_case();
  const int nodes = 1 + std::accumulate(rings().nodes.begin(), rings().nodes.end(), 0);
  EXPECT_EQ(frames.num_frames(), base_frames() ? nodes + rings().nodes.back() : nodes);
  std::set<int> seen;
  const auto points = frames.coordinates().space().wall_points(4);
  for (std::size_t q = 0; q < points.tet.size(); ++q) {
    double sum = 0;
    Vec3 gradient = Vec3::Zero();
    const Vec4 l = points.barycentric.col(static_cast<Eigen::Index>(q));
    for (const auto& [frame, f] : by_frame(frames.sample(points.tet[q], l))) {
      EXPECT_GE(f.weight, 0);
      EXPECT_LE(f.weight, 1 + 1e-14);
      sum += f.weight;
      gradient += f.weight_gradient;
      seen.insert(frame);
    }
    EXPECT_NEAR(sum, 1, 1e-13);
    EXPECT_LT(gradient.norm(), 1e-12);
  }
  EXPECT_EQ(static_cast<int>(seen.size()), frames.num_frames());
}

TEST_P(Frames, GradientsMatchFiniteDifferences) {
  const SegmentFrames frames = frames_of_case();
  const auto& c = frames.coordinates();
  constexpr double kStep = 1e-5;
  int compared = 0;
  double steepest = 0;
  for (int t = 0; t < LandEllipsoid::get().mesh.num_tets(); t += 3) {
    const Vec4 l(0.3, 0.3, 0.25, 0.15);
    const FramesAtPoint at = frames.sample(t, l);
    // Close to the axis the angle varies too fast for the step.
    if (c.position(t, l).head<2>().norm() < 1) continue;
    for (int k = 1; k < 4; ++k) {
      const Vec4 d = kStep * (Vec4::Unit(k) - Vec4::Unit(0));
      auto ahead = by_frame(frames.sample(t, l + d));
      auto back = by_frame(frames.sample(t, l - d));
      const Vec3 dX = c.position(t, l + d) - c.position(t, l - d);
      for (const FrameSample& f : at.frames) {
        if (!ahead.contains(f.frame) || !back.contains(f.frame)) continue;  // a kink lies between
        ++compared;
        // Rounding of the differences, 1e-15, and third order in the step.
        EXPECT_NEAR(ahead[f.frame].weight - back[f.frame].weight, f.weight_gradient.dot(dX), 1e-12);
        EXPECT_LT((ahead[f.frame].xi - back[f.frame].xi - f.xi_gradient * dX).norm(), 1e-12);
        steepest = std::max(steepest, f.weight_gradient.norm());
      }
    }
  }
  EXPECT_GT(compared, 500);
  EXPECT_GT(steepest, 0.05);
}

INSTANTIATE_TEST_SUITE_P(SegmentFrames, Frames,
                         ::testing::Combine(::testing::Range(0, static_cast<int>(kLayouts.size())),
                                            ::testing::Bool()));

TEST(SegmentFrames, AFrameIsAloneAtItsNodeAndItsCoordinatesVanishThere) {
  const SegmentFrames frames = make_frames(true);
  const double ring = frames.layout().rings[1].u;
  // The point of the mesh that is closest to the node of segment 9, at ψ = 120°, in (u, ψ, t).
  double closest = 1e9;
  FramesAtPoint best;
  for (int t = 0; t < LandEllipsoid::get().mesh.num_tets(); ++t)
    for (double a = 0; a <= 1; a += 0.1)
      for (double b = 0; a + b <= 1; b += 0.1)
        for (double c = 0; a + b + c <= 1; c += 0.1) {
          const Vec4 l(a, b, c, 1 - a - b - c);
          const CoordinateSample s = frames.coordinates().sample(t, l);
          const double distance = Vec3(s.u - ring, s.psi - 2 * kPi / 3, s.t - 0.5).norm();
          if (distance >= closest) continue;
          closest = distance;
          best = frames.sample(t, l);
        }
  auto at = by_frame(best);
  ASSERT_TRUE(at.contains(8));
  EXPECT_GT(at[8].weight, 0.8);  // the point is off by a few hundredths
  EXPECT_LT(at[8].xi.norm(), 0.2);
}

TEST(SegmentFrames, TheCapHasCartesianCoordinatesAboutAPointOfTheAxis) {
  const SegmentFrames frames = make_frames(true);
  const Mat3 axes = cap_axes(frames.coordinates());
  const Vec3 node = cap_node_position(frames.coordinates(), frames.layout());
  EXPECT_LT((axes.transpose() * axes - Mat3::Identity()).norm(), 1e-12);
  EXPECT_NEAR(axes.determinant(), -1, 1e-12);             // left-handed like the local axes
  EXPECT_LT((axes.col(2) + Vec3::UnitZ()).norm(), 1e-6);  // out of the apex
  EXPECT_NEAR(node.z(), -18.5, 0.4);                      // in the middle of the wall of the apex
  int seen = 0;
  for (int t = 0; t < LandEllipsoid::get().mesh.num_tets(); ++t) {
    auto at = by_frame(frames.sample(t, Vec4::Constant(0.25)));
    if (!at.contains(16)) continue;
    ++seen;
    const Vec3 X = frames.coordinates().position(t, Vec4::Constant(0.25));
    EXPECT_LT((node + frames.layout().length * axes * at[16].xi - X).norm(), 1e-12);
  }
  EXPECT_GT(seen, 10);
}

TEST(SegmentFrames, BaseFramesWithLongitudinalFunctionsVanishOnTheBase) {
  const auto& land = LandEllipsoid::get();
  const auto frames = std::make_shared<SegmentFrames>(make_frames(true));
  std::vector<polyaffine::FrameFunctions> functions(23, {polyaffine::affine_monomials(), true});
  for (int i = kAhaSegments; i < 23; ++i) functions[i].monomials = {{1, 0, 0}, {1, 1, 0}, {1, 0, 1}};
  const polyaffine::FrameBasis basis(frames, functions);
  const auto points = frames->coordinates().space().surface_points(land.mesh, {3}, 4);
  ASSERT_GT(points.tet.size(), 50U);
  double slope = 0;
  for (std::size_t q = 0; q < points.tet.size(); ++q) {
    const auto s = basis.sample(points.tet[q], points.barycentric.col(static_cast<Eigen::Index>(q)));
    EXPECT_LT(s.N.cwiseAbs().maxCoeff(), 1e-12);
    slope = std::max(slope, s.gradient.cwiseAbs().maxCoeff());
  }
  EXPECT_GT(slope, 0.05);  // 1/mm: their slope is free
}

TEST_P(Frames, CellsCoverTheWallAndSeeTheSameFrames) {
  if (!base_frames()) return;
  const auto& land = LandEllipsoid::get();
  const SegmentFrames frames = frames_of_case();
  std::map<int, std::set<int>> frames_of;
  const auto points = land.coordinates->space().wall_points(4);
  for (std::size_t q = 0; q < points.tet.size(); ++q) {
    const Vec4 l = points.barycentric.col(static_cast<Eigen::Index>(q));
    const CoordinateSample s = land.coordinates->sample(points.tet[q], l);
    const auto cell = frames.cell(s.u, s.psi);
    ASSERT_GE(cell.index, 0);
    ASSERT_LT(cell.index, frames.num_cells());
    EXPECT_GE(cell.u, -0.1);  // quadratic interpolation passes 0 and 1 by a little
    EXPECT_LE(cell.u, 1.1);
    EXPECT_GE(cell.psi, 0);
    EXPECT_LE(cell.psi, 1);
    if (s.u <= 0 || s.u >= 1) continue;
    std::set<int> here;
    for (const auto& f : frames.sample(points.tet[q], l).frames) here.insert(f.frame);
    const auto [it, first] = frames_of.try_emplace(cell.index, here);
    EXPECT_EQ(it->second, here) << "cell " << cell.index;
  }
  EXPECT_EQ(static_cast<int>(frames_of.size()), frames.num_cells());
}

TEST(SegmentFrames, CellsBreakAtTheNodesOfBothRings) {
  // Below the apical ring its 4 sectors, then the 8 of 4 and 6 nodes together, then 6 and 6.
  EXPECT_EQ(make_frames(true).num_cells(), 24);
  // 3, then 3 + 5 at angles that all differ, then 5.
  EXPECT_EQ(make_frames(true, kLayouts[2]).num_cells(), 3 + 8 + 5);
  // 12, four times 24 and 12.
  EXPECT_EQ(make_frames(true, kLayouts[4]).num_cells(), 12 + 4 * 24 + 12);
}

}  // namespace
}  // namespace cardiac
