#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <polyaffine/core/error.hpp>
#include <polyaffine/mesh/surface.hpp>
#include <random>

#include "polyaffine/mesh/unit_cube.hpp"
#include "support/error_of.hpp"

namespace polyaffine {
namespace {

using ::testing::AllOf;
using testing::error_of;
using ::testing::HasSubstr;

struct Shell {
  Points points;
  Triangles triangles;
};

/// An ellipsoid (semi-axes a, a, c about the origin) below z = top, rings × sectors quads cut in two, with
/// normals to the inside: the inner wall of a cavity. Closed at the lower pole, open at the top.
Shell cup(double a, double c, double top, int rings, int sectors) {
  Shell shell{Points(3, 1 + rings * sectors), Triangles(3, sectors * (2 * rings - 1))};
  shell.points.col(0) = Vec3(0, 0, -c);
  const double last = std::acos(-top / c);
  for (int r = 0; r < rings; ++r)
    for (int s = 0; s < sectors; ++s) {
      const double polar = last * (r + 1) / rings, turn = 2 * kPi * s / sectors;
      shell.points.col(1 + r * sectors + s) = Vec3(
          a * std::sin(polar) * std::cos(turn), a * std::sin(polar) * std::sin(turn), -c * std::cos(polar));
    }
  Eigen::Index t = 0;
  for (int s = 0; s < sectors; ++s) {
    const int next = (s + 1) % sectors;
    shell.triangles.col(t++) << 0, 1 + s, 1 + next;
    for (int r = 0; r + 1 < rings; ++r) {
      const int low = 1 + r * sectors, high = low + sectors;
      shell.triangles.col(t++) << low + s, high + s, high + next;
      shell.triangles.col(t++) << low + s, high + next, low + next;
    }
  }
  return shell;
}

/// Volume of the ellipsoid below z = top.
double cup_volume(double a, double c, double top) {
  return kPi * a * a * (2 * c / 3 + top - top * top * top / (3 * c * c));
}

TEST(Surface, AreasOfTheCube) {
  const auto cube = testing::unit_cube();
  const TetMesh mesh(3 * cube.points, cube.tets, {}, testing::cube_labels());
  EXPECT_NEAR(surface_area(mesh, {1}), 9, 1e-13);
  EXPECT_NEAR(surface_area(mesh, {1, 2}), 18, 1e-13);
  EXPECT_NEAR(triangle_areas(mesh.points(), mesh.boundary()).sum(), 54, 1e-12);
  EXPECT_EQ(surface_area(mesh, {5}), 0);
}

TEST(EnclosedVolume, ConvergesToTheEllipsoidWithSecondOrder) {
  const double a = 20, c = 60, top = 15, exact = cup_volume(a, c, top);
  std::vector<double> errors;
  for (const int n : {10, 20, 40}) {
    const Shell shell = cup(a, c, top, n, 2 * n);
    const EnclosedVolume volume(shell.triangles);
    ASSERT_EQ(volume.rims().size(), 1U);
    EXPECT_EQ(volume.rims()[0].size(), static_cast<std::size_t>(2 * n));
    errors.push_back((exact - volume.value(shell.points)) / exact);
    EXPECT_GT(errors.back(), 0) << "an inscribed polyhedron is smaller";
  }
  // The gap between chords and a smooth surface falls with h².
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2, 0.05);
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2, 0.05);
  EXPECT_LT(errors[2], 0.005);
}

TEST(EnclosedVolume, ClosedSurfaceNeedsNoFan) {
  const auto cube = testing::unit_cube();
  const TetMesh mesh(2 * cube.points, cube.tets);
  Triangles inward = mesh.boundary();
  inward.row(0).swap(inward.row(1));
  const EnclosedVolume volume(inward);
  EXPECT_TRUE(volume.rims().empty());
  EXPECT_NEAR(volume.value(mesh.points()), 8, 1e-13);
  EXPECT_NEAR(EnclosedVolume(mesh.boundary()).value(mesh.points()), -8, 1e-13) << "the outside of a solid";
}

TEST(EnclosedVolume, OpenCubeOnBothEndsHasTwoRims) {
  const auto cube = testing::unit_cube();
  const TetMesh mesh(cube.points, cube.tets, {}, testing::cube_labels());
  const EnclosedVolume volume(mesh, {TetMesh::kUnlabelled});
  ASSERT_EQ(volume.rims().size(), 2U);
  EXPECT_EQ(volume.rims()[0].front(), 0);
  EXPECT_EQ(volume.rims()[0].size(), 4U);
  EXPECT_EQ(volume.rims()[1].front(), 4);
  EXPECT_NEAR(volume.value(mesh.points()), -1, 1e-14);
}

TEST(EnclosedVolume, DoesNotDependOnTheOriginAndTurns) {
  const Shell shell = cup(7, 17, 5, 8, 12);
  const EnclosedVolume volume(shell.triangles);
  const double here = volume.value(shell.points);
  const Mat3 turn = Eigen::AngleAxisd(1.1, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
  const Points there = (turn * shell.points).colwise() + Vec3(300, -200, 100);
  // Products of coordinates of order 300 cancel: 300³ × 1e-16 per triangle.
  EXPECT_NEAR(volume.value(there), here, 1e-6);
  const Mat3 stretch = Vec3(1.2, 0.9, 1.3).asDiagonal();
  EXPECT_NEAR(volume.value(stretch * shell.points), stretch.determinant() * here, 1e-10 * here);
}

TEST(EnclosedVolume, GradientMatchesFiniteDifferences) {
  const Shell shell = cup(7, 17, 5, 5, 8);
  const EnclosedVolume volume(shell.triangles);
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 0.3);
  Points points = shell.points;
  for (double& x : points.reshaped()) x += noise(random);
  const Points gradient = volume.gradient(points);
  EXPECT_GT(gradient.colwise().norm().minCoeff(), 0.1) << "every vertex moves some volume";
  const double h = 1e-3;
  for (Eigen::Index i = 0; i < points.size(); ++i) {
    Points plus = points, minus = points;
    plus.data()[i] += h;
    minus.data()[i] -= h;
    // The volume is at most cubic in one coordinate, so only rounding (V × 1e-16 / h) is left.
    EXPECT_NEAR(gradient.data()[i], (volume.value(plus) - volume.value(minus)) / (2 * h), 1e-8);
  }
  EXPECT_LT(gradient.rowwise().sum().norm(), 1e-11) << "moving the whole cavity does not change its volume";
  EXPECT_NEAR(gradient.cwiseProduct(points).sum(), 3 * volume.value(points), 1e-9) << "V scales with length³";
}

TEST(EnclosedVolume, GradientIsZeroOffTheSurface) {
  const auto cube = testing::unit_cube();
  const TetMesh mesh(cube.points, cube.tets, {}, testing::cube_labels());
  const Points gradient = EnclosedVolume(mesh, {1}).gradient(mesh.points());
  EXPECT_EQ(gradient.rightCols(4).norm(), 0);
}

TEST(EnclosedVolume, OpenCavities) {
  const auto cube = testing::unit_cube();
  const TetMesh mesh(cube.points, cube.tets, {}, testing::cube_labels());
  EXPECT_THAT(error_of([&] { EnclosedVolume(mesh, {7}); }),
              AllOf(HasSubstr("open cavity"), HasSubstr("label 7"), HasSubstr("0, 1, 2")));
  EXPECT_THAT(error_of([] { EnclosedVolume(Triangles(3, 0)); }), HasSubstr("open cavity"));

  Triangles bow(3, 2);  // two triangles that meet in a point
  bow.col(0) << 0, 1, 2;
  bow.col(1) << 0, 3, 4;
  EXPECT_THAT(error_of([&] { EnclosedVolume{bow}; }), AllOf(HasSubstr("open cavity"), HasSubstr("point 0")));

  Triangles turned(3, 2);  // neighbours of opposite orientation
  turned.col(0) << 0, 1, 2;
  turned.col(1) << 0, 1, 3;
  EXPECT_THAT(error_of([&] { EnclosedVolume{turned}; }),
              AllOf(HasSubstr("open cavity"), HasSubstr("0 and 1")));

  Shell shell = cup(7, 17, 5, 4, 6);
  Triangles torn = shell.triangles.rightCols(shell.triangles.cols() - 1);
  EXPECT_EQ(rim_loops(torn).size(), 2U) << "a hole away from the rim is a second rim";
  torn = shell.triangles;
  torn.col(torn.cols() - 2).swap(torn.col(0));
  EXPECT_THAT(rim_loops(torn.rightCols(torn.cols() - 1)), ::testing::SizeIs(1)) << "a notch in the rim";
}

}  // namespace
}  // namespace polyaffine
