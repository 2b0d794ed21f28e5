#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <polyaffine/mesh/quality.hpp>

#include "polyaffine/mesh/unit_cube.hpp"

namespace polyaffine {
namespace {

using TetPoints = Eigen::Matrix<double, 3, 4>;

TetPoints regular_tet() {
  TetPoints x;
  x << 1, 1, -1, -1,  //
      1, -1, 1, -1,   //
      1, -1, -1, 1;
  return x;
}

TetPoints corner_tet() {
  TetPoints x = TetPoints::Zero();
  x.rightCols(3) = Mat3::Identity();
  return x;
}

constexpr double kRounding = 1e-12;  // a few operations on numbers of order 1 to 100

TEST(Quality, RegularTetIsPerfect) {
  for (const double angle : dihedral_angles_deg(regular_tet()))
    EXPECT_NEAR(angle, std::acos(1.0 / 3) * 180 / kPi, kRounding);
  EXPECT_NEAR(aspect_ratio(regular_tet()), 1, kRounding);
  EXPECT_NEAR(radius_ratio(regular_tet()), 1, kRounding);
}

TEST(Quality, CornerTetByHand) {
  // Three right angles at the corner; the slanted face meets the others at acos(1/√3).
  const auto angles = dihedral_angles_deg(corner_tet());
  EXPECT_EQ(
      std::count_if(angles.begin(), angles.end(), [](double a) { return std::abs(a - 90) < kRounding; }), 3);
  EXPECT_NEAR(*std::min_element(angles.begin(), angles.end()), std::acos(1 / std::sqrt(3)) * 180 / kPi,
              kRounding);
  // Longest edge √2, shortest height 1/√3 (onto the slanted face).
  EXPECT_NEAR(aspect_ratio(corner_tet()), std::sqrt(2) * std::sqrt(3) / std::sqrt(1.5), kRounding);
  // r_in = 1/(3 + √3), r_circ = √3/2.
  EXPECT_NEAR(radius_ratio(corner_tet()), 3 / (3 + std::sqrt(3)) / (std::sqrt(3) / 2), kRounding);
}

TEST(Quality, DoesNotChangeWithSizeAndPosition) {
  const TetPoints moved =
      (7 * Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix() * corner_tet()).colwise() +
      Vec3(10, -20, 30);
  EXPECT_NEAR(aspect_ratio(moved), aspect_ratio(corner_tet()), 1e-11);
  EXPECT_NEAR(radius_ratio(moved), radius_ratio(corner_tet()), 1e-11);
}

TEST(Quality, SliversAreFound) {
  TetPoints sliver;  // four points near a square
  sliver << 1, 0, -1, 0, 0, 1, 0, -1, 1e-3, -1e-3, 1e-3, -1e-3;
  const auto angles = dihedral_angles_deg(sliver);
  EXPECT_LT(*std::min_element(angles.begin(), angles.end()), 0.5);
  EXPECT_GT(*std::max_element(angles.begin(), angles.end()), 179);
  EXPECT_LT(radius_ratio(sliver), 0.01);
  EXPECT_GT(aspect_ratio(sliver), 100);
}

TEST(Quality, SummaryOfTheCube) {
  const auto cube = testing::unit_cube();
  const auto q = mesh_quality(TetMesh(10 * cube.points, cube.tets));
  EXPECT_NEAR(q.min_edge_mm, 10, kRounding);
  EXPECT_NEAR(q.max_edge_mm, 10 * std::sqrt(3), kRounding);
  // Every tet: three edges, two face diagonals, one space diagonal.
  EXPECT_NEAR(q.mean_edge_mm, 10 * (3 + 2 * std::sqrt(2) + std::sqrt(3)) / 6, 1e-11);
  EXPECT_NEAR(q.min_volume_mm3, 1000.0 / 6, 1e-10);
  EXPECT_NEAR(q.min_dihedral_deg, 45, kRounding);
  EXPECT_NEAR(q.max_dihedral_deg, 90, kRounding);
  EXPECT_NEAR(q.min_radius_ratio, q.mean_radius_ratio, kRounding) << "the six tets are congruent";
  EXPECT_NEAR(q.max_aspect_ratio, q.mean_aspect_ratio, kRounding);
}

}  // namespace
}  // namespace polyaffine
