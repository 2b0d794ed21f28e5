#include "cardiac/strain/affine_fit.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include <cardiac/anatomy/segments.hpp>

#include "support/affine_rebuild.hpp"
#include "support/land_ellipsoid.hpp"
#include "support/random_vector.hpp"

namespace cardiac {
namespace {

using polyaffine::Mat3;
using polyaffine::Points;
using polyaffine::Vec3;
using polyaffine::testing::random_vector;
using testing::LandEllipsoid;

const polyaffine::TetMesh& mesh() {
  return LandEllipsoid::get().mesh;
}

const std::vector<int>& segment() {
  static const auto out = segment_tets(mesh(), *LandEllipsoid::get().coordinates);
  return out;
}

const std::vector<ControlNode>& nodes() {
  const auto& coordinates = *LandEllipsoid::get().coordinates;
  static const auto out = control_nodes(mesh(), coordinates, frame_layout(mesh(), coordinates));
  return out;
}

/// A motion that is affine nowhere.
Points bent(const Points& X, double amount) {
  Points out = X;
  for (auto x : out.colwise()) {
    const double turn = amount * x.z();
    x = Eigen::AngleAxisd(turn, Vec3::UnitZ()) *
        Vec3(x * (1 + amount * std::sin(x.x()) + 0.05 * amount * x.y()));
  }
  return out;
}

TEST(AffineFit, RecoversAGlobalAffineMapFromAnyEndDiastole) {
  const Points ed = bent(mesh().points(), 0.02);
  const Mat3 G = Mat3::Identity() + random_vector(9, 0.4, 2).reshaped(3, 3);
  const Vec3 b = random_vector(3, 10, 3);
  const AffineFit fit(mesh(), segment(), nodes(), ed);
  const auto frames = fit.frames((G * ed).colwise() + b);
  ASSERT_EQ(frames.size(), kAhaSegments);
  for (int i = 0; i < kAhaSegments; ++i) {
    SCOPED_TRACE(aha_name(i + 1));
    const ControlNode& node = nodes()[i];
    const Vec3 q = ed(Eigen::all, mesh().tets().col(node.tet)) * node.barycentric;
    // In the axes R of the node: A = Rᵀ G R, t = Rᵀ (G q + b − q).
    EXPECT_LT((frames[i].A - node.axes.transpose() * G * node.axes).norm(), 1e-9);
    EXPECT_LT((frames[i].t - node.axes.transpose() * (G * q + b - q)).norm(), 1e-8);
    EXPECT_LT(frames[i].misfit, 1e-9);
    EXPECT_LT((fit.node_positions().col(i) - q).norm(), 1e-12);
  }
}

TEST(AffineFit, ComesAsCloseToABentMotionAsAnyAffineMap) {
  const Points ed = bent(mesh().points(), 0.02);
  const Points x = bent(mesh().points(), -0.03);
  const AffineFit fit(mesh(), segment(), nodes(), ed);
  const auto frames = fit.frames(x);
  std::vector<SegmentNode> at;
  for (int i = 0; i < kAhaSegments; ++i) at.push_back({fit.node_positions().col(i), nodes()[i].axes});
  const auto errors = testing::rebuild_errors(mesh(), segment(), ed, x, at, frames);
  for (int i = 0; i < kAhaSegments; ++i) {
    SCOPED_TRACE(aha_name(i + 1));
    EXPECT_GT(errors[i].best, 1e-3);
    EXPECT_LT(errors[i].maps, (1 + 1e-9) * errors[i].best);
    EXPECT_NEAR(frames[i].misfit, errors[i].best, 1e-9);
  }
}

TEST(AffineFit, OfNoMotionIsTheIdentityWithoutMisfit) {
  for (const SegmentFrame& f :
       AffineFit(mesh(), segment(), nodes(), mesh().points()).frames(mesh().points())) {
    EXPECT_EQ(f.A, Mat3::Identity());
    EXPECT_EQ(f.t, Vec3::Zero());
    EXPECT_TRUE(std::isnan(f.misfit));
  }
}

}  // namespace
}  // namespace cardiac
