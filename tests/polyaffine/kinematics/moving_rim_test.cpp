#include "polyaffine/kinematics/moving_rim.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <polyaffine/core/error.hpp>
#include <polyaffine/material/signed_volume.hpp>
#include <polyaffine/system/field_energy.hpp>

#include "support/labelled_box.hpp"
#include "support/random_vector.hpp"

namespace polyaffine {
namespace {

// Five faces of a box of 2 × 3 × 1 mm: what is open is z = 1. Their tangents are turned, as those of a cavity
// in a body are, so that volumes come out negative here.
struct OpenBox {
  TetMesh mesh = testing::labelled_box(Vec3::Zero(), Vec3(2, 3, 1), {2, 2, 1}, 0.1);
  std::vector<int> walls{testing::kXLow, testing::kXHigh, testing::kYLow, testing::kYHigh, testing::kZLow};
  LagrangeBasis basis;
  SurfacePoints points;
  MovingRim rim;

  explicit OpenBox(int order)
      : basis(mesh, order), points(basis.surface_points(mesh, walls, order == 1 ? 1 : 4)) {
    points.X_xi.swap(points.X_eta);
    rim = moving_rim(basis, mesh, walls, Vec3(1, 1.5, 1));
  }
  FieldEnergy volume(FieldTable table) const {
    return FieldEnergy(std::move(table), {std::make_shared<SignedVolume>(1.0 / 3)});
  }
  FieldEnergy cones() const { return volume(surface_table(basis, points, rim.centre)); }
  FieldEnergy closed(const Vec3& origin) const {
    return volume(joined(surface_table(basis, points, origin), lid_table(basis, rim, origin)));
  }
};

class MovingRims : public ::testing::TestWithParam<int> {};

TEST_P(MovingRims, CloseTheSurfaceByTheDivergenceTheorem) {
  const OpenBox box(GetParam());
  const Vector c = testing::random_vector(3 * box.basis.num_functions(), 0.1, 1);
  EXPECT_NEAR(box.cones().evaluate({Vector::Zero(c.size())}).value, -6, 1e-12);
  EXPECT_NEAR(box.rim.centre.position.z(), 1, 1e-15);
  const double expected = box.cones().evaluate({c}).value;
  // Both forms are the same volume, whatever the origin of the flux.
  for (const Vec3& origin : {Vec3(0, 0, 0), Vec3(5, -7, 2)})
    EXPECT_NEAR(box.closed(origin).evaluate({c}).value, expected, 1e-12 * std::abs(expected));
}

TEST_P(MovingRims, RigidMotionsKeepTheVolume) {
  const OpenBox box(GetParam());
  const Vector c = testing::random_vector(3 * box.basis.num_functions(), 0.1, 2);
  const Mat3 R = Eigen::AngleAxisd(1.7, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  const Points x = box.basis.nodes() + c.reshaped(3, box.basis.num_functions());
  const Points moved = ((R * x).colwise() + Vec3(4, 5, -6)) - box.basis.nodes();
  for (const FieldEnergy& energy : {box.cones(), box.closed(Vec3(1, 1, 1))})
    EXPECT_NEAR(energy.evaluate({moved.reshaped()}).value, energy.evaluate({c}).value, 1e-12 * 6);
}

TEST_P(MovingRims, MeanMotionIsThatOfARigidBody) {
  const OpenBox box(GetParam());
  const Vec3 axis = Vec3::UnitZ(), moved(0.1, -0.2, 0.3);
  const double angle = 1e-3;
  const Points u = (angle * Mat3{{0, -1, 0}, {1, 0, 0}, {0, 0, 0}} *
                    (box.basis.nodes().colwise() - box.rim.centre.position))
                       .colwise() +
                   moved;
  const Matrix M = evaluate_field(mean_motion_table(box.basis, box.rim.centre, axis), u.reshaped());
  EXPECT_LT((M.col(0).head<3>() - moved).norm(), 1e-14);
  EXPECT_LT((M.col(0).segment<3>(3) - angle * axis).norm(), 1e-15);
}

INSTANTIATE_TEST_SUITE_P(Orders, MovingRims, ::testing::Values(1, 2));

TEST(MovingRim, ClosedSurfaceIsRefused) {
  const OpenBox box(1);
  std::vector<int> all = box.walls;
  all.push_back(testing::kZHigh);
  EXPECT_THROW(moving_rim(box.basis, box.mesh, all, Vec3::Zero()), InputError);
}

}  // namespace
}  // namespace polyaffine
