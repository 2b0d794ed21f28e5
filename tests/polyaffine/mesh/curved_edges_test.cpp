#include "polyaffine/mesh/curved_edges.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include <polyaffine/kinematics/lagrange.hpp>

#include "support/convergence.hpp"
#include "support/labelled_box.hpp"

namespace polyaffine {
namespace {

using testing::BoxFace;

constexpr double kInner = 1, kOuter = 1.6;  // mm

// A 24th of a spherical shell: kXLow and kXHigh are the spheres, the other labels the four planes.
TetMesh shell(int n, bool labelled = true) {
  const TetMesh mesh = testing::mapped(
      testing::labelled_box(Vec3(kInner, 0, 0), Vec3(kOuter, 1, 1), {1, n, n}), testing::to_sphere);
  return labelled ? mesh : TetMesh(mesh.points(), mesh.tets());
}

// Labels of the boundary triangles at each edge.
std::map<std::pair<int, int>, std::set<int>> edge_labels(const TetMesh& mesh) {
  std::map<std::pair<int, int>, std::set<int>> out;
  for (Eigen::Index f = 0; f < mesh.boundary().cols(); ++f)
    for (int k = 0; k < 3; ++k)
      out[std::minmax(mesh.boundary()(k, f), mesh.boundary()((k + 1) % 3, f))].insert(
          mesh.boundary_labels()[f]);
  return out;
}

Vec3 middle(const TetMesh& mesh, const std::pair<int, int>& edge) {
  return (mesh.points().col(edge.first) + mesh.points().col(edge.second)) / 2;
}

// Largest distance from the outer sphere of midpoints on it, in the same part of it for every mesh, away from
// its rim, where the normals know one side only.
double sphere_error(int n, bool straight) {
  const TetMesh mesh = shell(n);
  const EdgeMidpoints midpoints = smooth_midpoints(mesh);
  double worst = 0;
  for (const auto& [edge, at] : edge_labels(mesh)) {
    const Vec3 m = straight ? middle(mesh, edge) : midpoints.at(edge);
    const double y = m.y() / m.x();
    const double z = m.z() / m.x();
    if (at == std::set<int>{BoxFace::kXHigh} && std::min(y, z) > 0.25 && std::max(y, z) < 0.75)
      worst = std::max(worst, std::abs(m.norm() - kOuter));
  }
  return worst;
}

TEST(CurvedEdges, MidpointsComeToTheSphereWithTheThirdOrder) {
  const double coarse = sphere_error(8, false);
  const double fine = sphere_error(16, false);
  EXPECT_GT(coarse, 0);
  EXPECT_GT(testing::order(coarse, fine), 2.8);
  EXPECT_NEAR(testing::order(sphere_error(8, true), sphere_error(16, true)), 2,
              0.3);  // the chords' own order
  EXPECT_LT(fine, sphere_error(16, true) / 20);
}

TEST(CurvedEdges, RimsStayInTheirPlaneAndFollowTheSphere) {
  const TetMesh mesh = shell(6);
  const EdgeMidpoints midpoints = smooth_midpoints(mesh);
  int seen = 0;
  for (const auto& [edge, at] : edge_labels(mesh)) {
    const Vec3 m = midpoints.at(edge);
    if (at.contains(BoxFace::kYLow)) {
      EXPECT_NEAR(m.y(), 0, 1e-14);
    }
    if (at.contains(BoxFace::kZLow)) {
      EXPECT_NEAR(m.z(), 0, 1e-14);
    }
    if (at.contains(BoxFace::kYHigh)) {
      EXPECT_NEAR(m.y(), m.x(), 1e-14);
    }
    if (at.contains(BoxFace::kZHigh)) {
      EXPECT_NEAR(m.z(), m.x(), 1e-14);
    }
    const bool outer = at.contains(BoxFace::kXHigh);
    if (at.size() < 2 || (!outer && !at.contains(BoxFace::kXLow))) continue;
    ++seen;
    // At a rim the normals know one side only and are of first order: a good part of the bend is missed.
    const double radius = outer ? kOuter : kInner;
    EXPECT_LT(std::abs(m.norm() - radius), 0.75 * std::abs(middle(mesh, edge).norm() - radius));
  }
  EXPECT_EQ(seen, 2 * 4 * 6);
}

TEST(CurvedEdges, UnlabelledAndFlatFacesStayStraight) {
  for (const TetMesh& mesh : {shell(3, false), testing::labelled_cube(2)})
    for (const auto& [edge, m] : smooth_midpoints(mesh)) EXPECT_LT((m - middle(mesh, edge)).norm(), 1e-14);
}

TEST(CurvedEdges, CurvedElementsHoldMoreOfTheVolume) {
  // (R³ − r³) 4π/3 / 24
  const double exact = kPi / 18 * (std::pow(kOuter, 3) - std::pow(kInner, 3));
  const auto error = [&](int n, bool curved) {
    const TetMesh mesh = shell(n);
    const LagrangeBasis basis(mesh, 2, curved ? smooth_midpoints(mesh) : EdgeMidpoints());
    return std::abs(basis.wall_points(4).weights.sum() - exact);
  };
  EXPECT_LT(error(4, true), error(4, false) / 2.5);
  EXPECT_LT(error(12, true), error(12, false) / 5);  // the rims lose weight
}

}  // namespace
}  // namespace polyaffine
