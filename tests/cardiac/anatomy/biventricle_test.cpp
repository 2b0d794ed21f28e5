#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <random>
#include <set>

#include <cardiac/anatomy/segments.hpp>
#include <cardiac/reduction/biventricular_frames.hpp>
#include <polyaffine/geometry/geodesic_regions.hpp>

#include "support/biventricle.hpp"

namespace cardiac {
namespace {

using polyaffine::kPi;
using polyaffine::TetMesh;
using polyaffine::Vec3;
using polyaffine::Vec4;
using testing::Biventricle;

const Vec4 kCentre = Vec4::Constant(0.25);

TEST(Biventricle, TransventricularTellsTheWallsApart) {
  const auto& both = Biventricle::get();
  const RightVentricularCoordinates& right = *both.coordinates->right();
  EXPECT_GE(right.transventricular().minCoeff(), -0.02);  // quadratic elements pass the bounds by a little
  EXPECT_LE(right.transventricular().maxCoeff(), 1.02);
  double total = 0, agree = 0;
  for (int t = 0; t < both.mesh.num_tets(); ++t) {
    const int found = right.border(t, kCentre).w > 0.5 ? kRvWall
                      : right.septal(t, kCentre) > 0   ? kSeptum
                                                       : kLvWall;
    total += both.mesh.tet_volume(t);
    agree += found == both.mesh.regions()[t] ? both.mesh.tet_volume(t) : 0;
  }
  EXPECT_GT(agree, 0.93 * total);  // the shape's own regions end on the left outer ellipsoid
}

TEST(Biventricle, AxisAndInsertionsComeFromTheMesh) {
  const auto& both = Biventricle::get();
  const auto& c = *both.coordinates;
  EXPECT_LT((c.axis() - Vec3::UnitZ()).norm(), 1e-6);
  EXPECT_LT((c.anterior() - Vec3::UnitY()).norm(), 0.03);  // the shape is its own mirror image in y
  // ψ is 30° and 150° where the septum ends, 90° in its middle.
  double in_arc = 0, septum = 0;
  for (int t = 0; t < both.mesh.num_tets(); ++t) {
    const double h = c.long_axis_height(both.mesh.tet_centroid(t));
    if (h < 1.0 / 3 || c.right()->border(t, kCentre).w > 0.5 || c.right()->septal(t, kCentre) < 0) continue;
    const double psi = c.sample(t, kCentre).psi;
    septum += both.mesh.tet_volume(t);
    in_arc += psi > kPi / 6 && psi < 5 * kPi / 6 ? both.mesh.tet_volume(t) : 0;
  }
  EXPECT_GT(in_arc, 0.93 * septum);
  EXPECT_NEAR(c.angle({40, 0, 0}), kPi / 2, 0.03);
  EXPECT_NEAR(std::abs(c.angle({-40, 0, 0})), kPi / 2, 0.03);
  EXPECT_GT(c.angle({30, 20, 0}), 0.1);
}

TEST(Biventricle, GradientsAreThoseOfTheCoordinates) {
  const auto& c = *Biventricle::get().coordinates;
  const auto& right = *c.right();
  const Vec4 at(0.3, 0.3, 0.2, 0.2), step(1e-6, -1e-6, 0, 0);
  int seen = 0;
  for (int t = 0; t < Biventricle::get().mesh.num_tets(); t += 7) {
    const Vec3 d = c.position(t, at + step) - c.position(t, at - step);
    const auto rotation = [&](double a, double b) { return std::remainder(a - b, 2 * kPi); };
    EXPECT_NEAR(rotation(c.sample(t, at + step).psi, c.sample(t, at - step).psi),
                c.sample(t, at).grad_psi.dot(d), 1e-9);
    EXPECT_NEAR(c.sample(t, at + step).u - c.sample(t, at - step).u, c.sample(t, at).grad_u.dot(d), 1e-9);
    EXPECT_NEAR(right.border(t, at + step).share - right.border(t, at - step).share,
                right.border(t, at).share_gradient.dot(d), 1e-9);
    EXPECT_NEAR(right.sample(t, at + step).t - right.sample(t, at - step).t,
                right.sample(t, at).grad_t.dot(d), 1e-9);
    const double half = right.half_angle();
    EXPECT_NEAR(rotation(half * right.sample(t, at + step).psi, half * right.sample(t, at - step).psi),
                half * right.sample(t, at).grad_psi.dot(d), 1e-9);
    seen += right.border(t, at).share > 0;
  }
  EXPECT_GT(seen, 100);
}

TEST(Biventricle, PlaceIsThatOfTheSampleWithItsStretchedAngle) {
  const auto& both = Biventricle::get();
  for (int t = 0; t < both.mesh.num_tets(); ++t) {
    const Vec4 at(0.4, 0.3, 0.2, 0.1);
    const CoordinateSample s = both.coordinates->sample(t, at);
    const CoordinatePlace place = both.coordinates->place(t, at);
    EXPECT_EQ(place.u, s.u);
    EXPECT_EQ(place.t, s.t);
    EXPECT_EQ(place.psi, s.psi);
  }
}

TEST(Biventricle, SegmentsAreConnectedAndCoverTheWall) {
  const auto& both = Biventricle::get();
  const std::vector<int> segment = segment_tets(both.mesh, *both.coordinates);
  EXPECT_EQ(segment, polyaffine::connect_regions(both.mesh, segment)) << "each of one piece";
  const std::vector<double> volume = segment_volumes(both.mesh, segment, kBothSegments);
  EXPECT_NEAR(std::accumulate(volume.begin(), volume.end(), 0.0), both.mesh.volume(),
              1e-9 * both.mesh.volume());
  for (int s = 1; s <= kBothSegments; ++s) EXPECT_GT(volume[s - 1], 1500) << aha_name(s);  // mm³
  for (int s = 1; s <= 6; ++s)
    EXPECT_NEAR(volume[s - 1], 6500, 2000) << aha_name(s);  // a sixth of the basal third of the left wall
  // Septal segments reach from the left to the right endocardium, others of the left wall do not touch both.
  std::set<int> left, right;
  for (Eigen::Index f = 0; f < both.mesh.boundary().cols(); ++f) {
    const int s = segment[both.mesh.boundary_tets()[f]];
    if (both.mesh.boundary_labels()[f] == kEndocardium) left.insert(s);
    if (both.mesh.boundary_labels()[f] == kRvEndocardium) right.insert(s);
  }
  for (const int s : {2, 3, 8, 9, 14}) EXPECT_TRUE(left.contains(s) && right.contains(s)) << aha_name(s);
  for (const int s : {5, 6, 11, 12, 16}) EXPECT_FALSE(right.contains(s)) << aha_name(s);
  for (int s = 18; s <= kBothSegments; ++s) EXPECT_FALSE(left.contains(s)) << aha_name(s);
}

/// The same heart turned, scaled and with its points and tets in another order; `from` is the old tet of
/// each.
TetMesh moved(const TetMesh& mesh, double scale, std::vector<int>& from) {
  std::mt19937 random(5);
  std::vector<int> point(mesh.num_points());
  from.resize(mesh.num_tets());
  std::iota(point.begin(), point.end(), 0);
  std::iota(from.begin(), from.end(), 0);
  std::shuffle(point.begin(), point.end(), random);
  std::shuffle(from.begin(), from.end(), random);
  std::vector<int> to(point.size());
  for (std::size_t i = 0; i < point.size(); ++i) to[point[i]] = static_cast<int>(i);
  const polyaffine::Mat3 turn =
      (Eigen::AngleAxisd(1.1, Vec3(1, 2, -1).normalized()) * Eigen::AngleAxisd(0.4, Vec3::UnitZ()))
          .toRotationMatrix();
  polyaffine::Points X = scale * (turn * mesh.points()(Eigen::all, point));
  X.colwise() += Vec3(100, -20, 7);
  polyaffine::Tets tets = mesh.tets()(Eigen::all, from);
  polyaffine::Triangles faces = mesh.boundary();
  for (int& p : tets.reshaped()) p = to[p];
  for (int& p : faces.reshaped()) p = to[p];
  return {X, tets, {}, {faces, mesh.boundary_labels()}};
}

TEST(Biventricle, SegmentsFollowTheHeartNotTheFile) {
  const auto& both = Biventricle::get();
  const std::vector<int> expected = segment_tets(both.mesh, *both.coordinates);
  std::vector<int> from;
  const double scale = 0.8;
  const TetMesh mesh = moved(both.mesh, scale, from);
  const VentricularCoordinates coordinates(mesh, testing::kBothLabels, {});
  const std::vector<int> found = segment_tets(mesh, coordinates);
  double same = 0;
  for (int t = 0; t < mesh.num_tets(); ++t) same += found[t] == expected[from[t]] ? mesh.tet_volume(t) : 0;
  EXPECT_GT(same, 0.999 * mesh.volume());
  EXPECT_NEAR(coordinates.arc_length(), scale * both.coordinates->arc_length(), 1e-3);
}

TEST(Biventricle, WeightsAreAPartitionOfUnityThatPassesThroughTheWall) {
  const auto& both = Biventricle::get();
  const FrameLayout layout = frame_layout(both.mesh, *both.coordinates);
  EXPECT_EQ(layout.num_nodes(), kBothSegments);
  for (const bool base_frames : {false, true}) {
    const BiventricularFrames frames(both.coordinates, layout, base_frames);
    std::set<int> seen;
    const Vec4 at(0.3, 0.3, 0.2, 0.2), step(1e-6, -1e-6, 0, 0);
    for (int t = 0; t < both.mesh.num_tets(); ++t) {
      double sum = 0;
      Vec3 gradient = Vec3::Zero();
      const double w = both.coordinates->right()->border(t, at).w;
      const auto here = frames.sample(t, at), after = frames.sample(t, at + step),
                 before = frames.sample(t, at - step);
      const Vec3 d = both.coordinates->position(t, at + step) - both.coordinates->position(t, at - step);
      ASSERT_EQ(here.frames.size(), after.frames.size());
      for (std::size_t i = 0; i < here.frames.size(); ++i) {
        const auto& f = here.frames[i];
        sum += f.weight;
        gradient += f.weight_gradient;
        seen.insert(f.frame);
        EXPECT_TRUE(frames.is_right(f.frame) ? w > 0.1 : w < 0.9);
        if (i < before.frames.size() && before.frames[i].frame == after.frames[i].frame) {
          EXPECT_NEAR(after.frames[i].weight - before.frames[i].weight, f.weight_gradient.dot(d), 1e-8);
          EXPECT_LT((after.frames[i].xi - before.frames[i].xi - f.xi_gradient * d).norm(), 1e-8);
        }
      }
      EXPECT_NEAR(sum, 1, 1e-12);
      EXPECT_LT(gradient.norm(), 1e-10);
    }
    EXPECT_EQ(static_cast<int>(seen.size()), frames.num_frames());
  }
}

}  // namespace
}  // namespace cardiac
