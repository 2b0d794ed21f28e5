#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include <polyaffine/core/error.hpp>
#include <polyaffine/geometry/geodesic_regions.hpp>
#include <polyaffine/quadrature/integration_regions.hpp>
#include "polyaffine/geometry/box_mesh.hpp"

namespace polyaffine {
namespace {

// A bar whose tets are ten times smaller at one end, with control regions of unequal size.
struct Scene {
  TetMesh mesh;
  std::vector<int> control;

  Scene() {
    const TetMesh even = box_mesh(Vec3::Zero(), Vec3(3, 1, 1), {24, 5, 5}, 0.2);
    Points points = even.points();
    points.row(0) = points.row(0).array() * (0.1 + points.row(0).array());
    mesh = TetMesh(points, even.tets());
    for (int t = 0; t < mesh.num_tets(); ++t) {
      const double x = mesh.tet_centroid(t)[0];
      control.push_back(x < 1 ? 0 : x < 3 ? 1 : 2);
    }
  }
};

TEST(IntegrationRegions, CarryTheTrueVolumeForEverySeed) {
  const Scene scene;
  const EikonalSolver solver(scene.mesh);
  const Vector volume = region_volumes(scene.mesh, scene.control, 3);
  for (const unsigned seed : {1u, 2u, 3u}) {
    std::mt19937_64 random(seed);
    // No relaxation for one of them: sampling as uneven as chance makes it.
    const IntegrationRegions regions =
        integration_regions(solver, scene.control, 3, 40, random, seed == 1 ? 0 : 10);
    ASSERT_EQ(regions.points.size(), 40);
    Vector sum = Vector::Zero(3);
    for (int i = 0; i < 40; ++i) sum[regions.control[i]] += regions.points.weights[i];
    EXPECT_LT((sum - volume).cwiseAbs().maxCoeff(), 1e-13 * scene.mesh.volume());
    EXPECT_LT((region_volumes(scene.mesh, regions.label, 40) - regions.points.weights).norm(), 1e-13);
    EXPECT_GT(regions.points.weights.minCoeff(), 0);
    for (int t = 0; t < scene.mesh.num_tets(); ++t)
      EXPECT_EQ(regions.control[regions.label[t]], scene.control[t]);
    for (int i = 0; i < 40; ++i) EXPECT_EQ(regions.label[regions.points.tet[i]], i);
  }
}

TEST(IntegrationRegions, PointsLieAtTheCentres) {
  const Scene scene;
  std::mt19937_64 random(4);
  const IntegrationRegions regions =
      integration_regions(EikonalSolver(scene.mesh), scene.control, 3, 30, random);
  Points moment = Points::Zero(3, 3), exact = Points::Zero(3, 3);
  const Points x = positions(scene.mesh, regions.points);
  for (int i = 0; i < 30; ++i) moment.col(regions.control[i]) += regions.points.weights[i] * x.col(i);
  for (int t = 0; t < scene.mesh.num_tets(); ++t)
    exact.col(scene.control[t]) += scene.mesh.tet_volume(t) * scene.mesh.tet_centroid(t);
  // First moments are kept too where the centre of volume lies in the region, as in these nearly convex ones.
  EXPECT_LT((moment - exact).norm(), 1e-3 * exact.norm());
}

TEST(ShareOut, IsProportionalWithinItsBounds) {
  EXPECT_EQ(share_out(10, Vec3(1, 2, 2), {100, 100, 100}), (std::vector<int>{2, 4, 4}));
  EXPECT_EQ(share_out(11, Vec3(1, 1, 1.2), {100, 100, 100}), (std::vector<int>{4, 3, 4}));
  EXPECT_EQ(share_out(4, Vec3(0.01, 1, 1), {9, 9, 9}), (std::vector<int>{1, 2, 1}));
  EXPECT_EQ(share_out(9, Vec3(10, 1, 1), {3, 9, 9}), (std::vector<int>{3, 3, 3}));
  EXPECT_THROW(share_out(2, Vec3(1, 1, 1), {9, 9, 9}), InputError);
  EXPECT_THROW(share_out(28, Vec3(1, 1, 1), {9, 9, 9}), InputError);
}

TEST(IntegrationRegions, RejectAnEmptyControlRegion) {
  const Scene scene;
  std::mt19937_64 random(4);
  EXPECT_THROW(integration_regions(EikonalSolver(scene.mesh), scene.control, 4, 40, random), InputError);
}

}  // namespace
}  // namespace polyaffine
