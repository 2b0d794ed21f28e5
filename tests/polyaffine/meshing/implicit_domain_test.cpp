#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <polyaffine/core/error.hpp>
#include <polyaffine/mesh/quality.hpp>
#include <polyaffine/mesh/surface.hpp>
#include <polyaffine/meshing/implicit_domain.hpp>

namespace polyaffine {
namespace {

constexpr double kRadius = 10;

ImplicitDomain ball() {
  ImplicitDomain domain;
  domain.value = [](const Vec3& x) { return x.norm() - kRadius; };
  domain.radius_mm = 1.2 * kRadius;
  domain.project = [](const Vec3& x) { return Vec3(kRadius * x.normalized()); };
  return domain;
}

MeshSizes sizes(double mm) {
  MeshSizes out;
  out.cell_mm = 0.75 * mm;
  out.facet_mm = 0.7 * mm;
  out.facet_distance_mm = 0.1 * mm;
  out.edge_mm = mm;
  return out;
}

/// The part of the ball below z = 0, with its sharp edge.
ImplicitDomain bowl() {
  ImplicitDomain domain = ball();
  domain.value = [](const Vec3& x) { return std::max(x.norm() - kRadius, x.z()); };
  Points edge(3, 201);
  for (int i = 0; i <= 200; ++i) {
    const double angle = 2 * kPi * (i % 200) / 200;
    edge.col(i) = kRadius * Vec3(std::cos(angle), std::sin(angle), 0);
  }
  domain.edges.push_back(edge);
  domain.project = nullptr;
  domain.label = [](const std::array<Vec3, 3>& t) {
    const double highest = std::min({t[0].z(), t[1].z(), t[2].z()});
    return highest > -1e-3 ? 2 : 1;
  };
  return domain;
}

TEST(ImplicitDomain, BallHasItsVolumeAndGoodTets) {
  const TetMesh mesh = mesh_implicit_domain(ball(), sizes(3));
  const double exact = 4 * kPi / 3 * std::pow(kRadius, 3);
  // Chords of length h leave a gap of h²/(8R) at most to the sphere: 3 × 9/800 of the volume.
  EXPECT_LT(mesh.volume(), exact);
  EXPECT_GT(mesh.volume(), exact * (1 - 3 * 9.0 / 800));
  const MeshQuality quality = mesh_quality(mesh);
  EXPECT_GT(quality.min_dihedral_deg, 10);
  EXPECT_NEAR(quality.mean_edge_mm, 3, 1);
  for (const int i : mesh.surface_points({TetMesh::kUnlabelled}))
    EXPECT_NEAR(mesh.points().col(i).norm(), kRadius, 1e-12) << "boundary vertices are projected";
}

TEST(ImplicitDomain, SmallerSizesConvergeToTheBall) {
  const double exact = 4 * kPi / 3 * std::pow(kRadius, 3);
  const double coarse = exact - mesh_implicit_domain(ball(), sizes(6)).volume();
  const double fine = exact - mesh_implicit_domain(ball(), sizes(3)).volume();
  // Second order would be 4 with exactly halved edges; facet sizes vary from vertex to vertex.
  EXPECT_GT(coarse / fine, 2.5);
  EXPECT_LT(coarse / fine, 7);
}

TEST(ImplicitDomain, KeepsTheSharpEdgeAndLabels) {
  const TetMesh mesh = mesh_implicit_domain(bowl(), sizes(3));
  EXPECT_GT(mesh.surface({1}).cols(), 50);
  EXPECT_GT(mesh.surface({2}).cols(), 20);
  EXPECT_TRUE(mesh.surface({TetMesh::kUnlabelled}).cols() == 0);
  const auto rims = rim_loops(mesh.surface({2}));
  ASSERT_EQ(rims.size(), 1U);
  for (const int i : rims[0]) {
    // On the polyline: chords of 200 segments lie R (1 − cos(π/200)) = 1.2e-3 inside the circle.
    EXPECT_NEAR(mesh.points().col(i).norm(), kRadius, 1.3e-3);
    EXPECT_NEAR(mesh.points()(2, i), 0, 1e-9);
  }
  EXPECT_NEAR(surface_area(mesh, {2}), kPi * kRadius * kRadius, 0.05 * kPi * kRadius * kRadius);
}

TEST(ImplicitDomain, IsTheSameEveryTime) {
  const TetMesh first = mesh_implicit_domain(bowl(), sizes(4));
  const TetMesh second = mesh_implicit_domain(bowl(), sizes(4));
  EXPECT_EQ(first.points(), second.points());
  EXPECT_EQ(first.tets(), second.tets());
}

TEST(ImplicitDomain, WrongSizesAreErrors) {
  for (const double wrong : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    MeshSizes s = sizes(3);
    s.cell_mm = wrong;
    EXPECT_THROW(mesh_implicit_domain(ball(), s), InputError) << wrong;
    s = sizes(3);
    s.edge_mm = wrong;
    EXPECT_THROW(mesh_implicit_domain(bowl(), s), InputError) << wrong;
  }
}

TEST(ImplicitDomain, SolidWithoutASurfaceIsAnError) {
  ImplicitDomain domain = ball();
  domain.value = [](const Vec3&) { return 1.0; };
  EXPECT_THROW(mesh_implicit_domain(domain, sizes(3)), InputError);
  domain.value = [](const Vec3&) { return -1.0; };
  EXPECT_THROW(mesh_implicit_domain(domain, sizes(3)), InputError);
}

}  // namespace
}  // namespace polyaffine
