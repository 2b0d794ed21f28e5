#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <queue>
#include <random>
#include <set>

#include <polyaffine/core/error.hpp>
#include <polyaffine/geometry/geodesic_regions.hpp>
#include "polyaffine/geometry/box_mesh.hpp"

namespace polyaffine {
namespace {

int parts_of(const TetMesh& mesh, const std::vector<int>& label, int region) {
  std::vector<char> seen(label.size(), 0);
  int parts = 0;
  for (int start = 0; start < mesh.num_tets(); ++start) {
    if (seen[start] || label[start] != region) continue;
    ++parts;
    std::queue<int> queue({start});
    seen[start] = 1;
    while (!queue.empty()) {
      const int t = queue.front();
      queue.pop();
      for (const int n : mesh.neighbours().col(t))
        if (n >= 0 && !seen[n] && label[n] == region) {
          seen[n] = 1;
          queue.push(n);
        }
    }
  }
  return parts;
}

TEST(VoronoiLabels, FollowTheNearestSeedOfABar) {
  const TetMesh mesh = box_mesh(Vec3::Zero(), Vec3(9, 1, 1), {27, 3, 3}, 0.2);
  const EikonalSolver solver(mesh);
  std::vector<MeshPoint> seeds;
  for (const double x : {1.5, 4.5, 7.5}) seeds.push_back(locate(mesh, Vec3(x, 0.5, 0.5)));
  const std::vector<int> label = voronoi_labels(solver, seeds);
  for (int t = 0; t < mesh.num_tets(); ++t) {
    const double x = mesh.tet_centroid(t)[0];
    if (std::abs(x - 3) > 0.4 && std::abs(x - 6) > 0.4) {
      EXPECT_EQ(label[t], static_cast<int>(x / 3));
    }
  }
}

TEST(VoronoiLabels, MeasureDistanceInsideTheWall) {
  // A U: the two arms lie side by side, the seed of the left arm is nearer through the gap.
  const TetMesh mesh = box_mesh(Vec3::Zero(), Vec3(5, 8, 1), {10, 16, 2}, 0,
                                [](const Vec3& x) { return x[0] < 2 || x[0] > 3 || x[1] < 1; });
  const EikonalSolver solver(mesh);
  const std::vector<MeshPoint> seeds{locate(mesh, Vec3(1, 7, 0.5)), locate(mesh, Vec3(4, 1.5, 0.5))};
  const std::vector<int> label = voronoi_labels(solver, seeds);
  for (int t = 0; t < mesh.num_tets(); ++t) {
    const Vec3 c = mesh.tet_centroid(t);
    if (c[0] > 3 && c[1] > 1) {
      EXPECT_EQ(label[t], 1) << c.transpose();
    }
  }
}

TEST(LloydRegions, AreConnectedEvenAndCentred) {
  const TetMesh mesh = box_mesh(Vec3::Zero(), Vec3(12, 1, 1), {36, 3, 3}, 0.2);
  const EikonalSolver solver(mesh);
  // Bad start: all four seeds at one end.
  std::vector<MeshPoint> seeds;
  for (const double x : {0.2, 0.6, 1.0, 1.5}) seeds.push_back(locate(mesh, Vec3(x, 0.5, 0.5)));
  const Vector before = region_volumes(mesh, voronoi_labels(solver, seeds), 4);
  const GeodesicRegions regions = lloyd_regions(solver, seeds, 200);
  const Vector after = region_volumes(mesh, regions.label, 4);
  EXPECT_NEAR(after.sum(), mesh.volume(), 1e-12 * mesh.volume());
  EXPECT_LT(before.minCoeff(), 0.5);
  EXPECT_GT(after.minCoeff(), 2.0);  // 3 each at the optimum; the relaxation stops a cell or two before it
  EXPECT_GT(regions.iterations, 1);
  EXPECT_LT(regions.iterations, 200);
  for (int r = 0; r < 4; ++r) {
    EXPECT_EQ(parts_of(mesh, regions.label, r), 1);
    EXPECT_EQ(regions.label[regions.seeds[r].tet], r);
  }
}

TEST(RandomSeeds, AreDifferentAndRepeatable) {
  const TetMesh mesh = box_mesh(Vec3::Zero(), Vec3(2, 1, 1), {8, 4, 4});
  std::vector<char> left(mesh.num_tets());
  for (int t = 0; t < mesh.num_tets(); ++t) left[t] = mesh.tet_centroid(t)[0] < 1;
  std::mt19937_64 one(3), two(3);
  const std::vector<MeshPoint> a = random_seeds(mesh, 50, one, left), b = random_seeds(mesh, 50, two, left);
  std::set<int> tets;
  for (size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].tet, b[i].tet);
    EXPECT_TRUE(left[a[i].tet]);
    tets.insert(a[i].tet);
  }
  EXPECT_EQ(tets.size(), 50u);
  EXPECT_THROW(random_seeds(mesh, mesh.num_tets() + 1, one), InputError);
}

TEST(RandomSeeds, AreProportionalToVolume) {
  const TetMesh even = box_mesh(Vec3::Zero(), Vec3::Ones(), {4, 2, 2});
  Points points = even.points();
  points.row(0) = points.row(0).cwiseAbs2();  // half of the tets fill a quarter of the box
  const TetMesh mesh(points, even.tets());
  std::mt19937_64 random(12);
  int in_quarter = 0;
  for (int i = 0; i < 4000; ++i)
    if (mesh.tet_centroid(random_seeds(mesh, 1, random)[0].tet)[0] < 0.25) ++in_quarter;
  EXPECT_NEAR(in_quarter / 4000.0, 0.25, 0.035);  // five standard deviations
}

TEST(ConnectRegions, GivesIslandsToTheirSurroundings) {
  const TetMesh mesh = box_mesh(Vec3::Zero(), Vec3(4, 1, 1), {16, 4, 4});
  std::vector<int> label(mesh.num_tets());
  for (int t = 0; t < mesh.num_tets(); ++t) {
    const Vec3 c = mesh.tet_centroid(t);
    label[t] = c[0] < 2 ? 0 : 1;
    if (c[0] > 3.5) label[t] = 0;  // a second part of region 0 behind region 1
    if ((c - Vec3(0.625, 0.625, 0.625)).norm() < 0.2) label[t] = 1;
  }
  ASSERT_GT(parts_of(mesh, label, 0), 1);
  ASSERT_GT(parts_of(mesh, label, 1), 1);
  const std::vector<int> repaired = connect_regions(mesh, label);
  for (int t = 0; t < mesh.num_tets(); ++t) EXPECT_EQ(repaired[t], mesh.tet_centroid(t)[0] < 2 ? 0 : 1);
}

TEST(BorderDistance, IsLinearAcrossTheMiddleRegionOfABar) {
  const TetMesh mesh = box_mesh(Vec3::Zero(), Vec3(9, 2, 2), {18, 4, 4});
  std::vector<int> label(mesh.num_tets());
  for (int t = 0; t < mesh.num_tets(); ++t) label[t] = static_cast<int>(mesh.tet_centroid(t)[0] / 3);
  const Matrix distance = normalised_border_distances(EikonalSolver(mesh), label, 3);
  for (int v = 0; v < mesh.num_points(); ++v) {
    const double x = mesh.points()(0, v);
    // Flat borders: the distance is exact up to rounding; the depth is 1.5 in the middle, 3 at the ends.
    EXPECT_NEAR(distance(1, v), (std::abs(x - 4.5) - 1.5) / 1.5, 1e-9);
    EXPECT_NEAR(distance(0, v), (x - 3) / 3, 1e-9);
    EXPECT_NEAR(distance(2, v), (6 - x) / 3, 1e-9);
  }
}

TEST(BorderDistance, KnowsAWholeMeshAndRejectsEmptyAndThinRegions) {
  const TetMesh mesh = box_mesh(Vec3::Zero(), Vec3::Ones(), {2, 2, 2});
  const EikonalSolver solver(mesh);
  std::vector<int> label(mesh.num_tets(), 0);
  EXPECT_EQ(normalised_border_distance(solver, label, 0), Vector::Constant(mesh.num_points(), -1));
  EXPECT_THROW(normalised_border_distance(solver, label, 1), InputError);
  for (int t = 0; t < mesh.num_tets(); ++t)
    if ((mesh.neighbours().col(t).array() >= 0).all()) {
      label[t] = 1;  // one tet: all four of its vertices are on its border
      break;
    }
  EXPECT_THROW(normalised_border_distance(solver, label, 1), InputError);
}

}  // namespace
}  // namespace polyaffine
