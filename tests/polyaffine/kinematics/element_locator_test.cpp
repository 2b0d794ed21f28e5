#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <polyaffine/core/error.hpp>
#include <polyaffine/kinematics/element_locator.hpp>

#include "support/labelled_box.hpp"
#include "support/sphere_midpoints.hpp"

namespace polyaffine {
namespace {

const TetMesh& shell() {
  static const TetMesh mesh = testing::mapped(
      testing::labelled_box(Vec3(1, 0, 0), Vec3(2, 1, 1), {2, 3, 3}, 0.1), testing::to_sphere);
  return mesh;
}

TEST(ElementLocator, FindsTheIntegrationPointsOfCurvedElements) {
  for (const int order : {1, 2}) {
    const LagrangeBasis elements(shell(), order, testing::sphere_midpoints(shell()));
    const ElementLocator locator(elements);
    const WallPoints points = elements.wall_points(3);
    for (std::size_t q = 0; q < points.tet.size(); ++q) {
      const Vec4 own = points.barycentric.col(static_cast<Eigen::Index>(q));
      const MeshPoint found = locator.locate(elements.position(points.tet[q], own));
      EXPECT_EQ(found.tet, points.tet[q]);
      EXPECT_LT((found.barycentric - own).cwiseAbs().maxCoeff(), 1e-11);
      EXPECT_EQ(found.distance, 0);
    }
  }
}

// Half way along the chord of an edge on the outer sphere the wall bulges by 2 (1 − cos(θ/2)): a straight
// element misses the point there, the curved one holds it.
TEST(ElementLocator, HoldsPointsBetweenChordAndArc) {
  const LagrangeBasis straight(shell(), 1), curved(shell(), 2, testing::sphere_midpoints(shell()));
  const Vec3 a = shell().points().col(shell().surface({testing::kXHigh})(0, 0));
  const Vec3 b = shell().points().col(shell().surface({testing::kXHigh})(1, 0));
  const double sagitta = 2 - (a + b).norm() / 2;
  ASSERT_GT(sagitta, 0.01);
  const Vec3 x = (2 - 0.05 * sagitta) * (a + b).normalized();
  EXPECT_EQ(ElementLocator(curved).locate(x).distance, 0);
  const MeshPoint beyond = ElementLocator(straight).locate(x);
  EXPECT_NEAR(beyond.distance, 0.95 * sagitta, 0.2 * sagitta);
  EXPECT_LT(beyond.barycentric.minCoeff(), 0);
  EXPECT_LT((straight.position(beyond.tet, beyond.barycentric) - x).norm(), 1e-12);
}

TEST(ElementLocator, ReachesPointsFarOutsideAndRefusesNonsense) {
  const LagrangeBasis straight(shell(), 1);
  const ElementLocator locator(straight);
  const MeshPoint inside = locator.locate(Vec3(0.5, 0.2, 0.2));
  EXPECT_GT(inside.distance, 0.3);
  EXPECT_LT(inside.distance, 0.6);
  EXPECT_THROW(locator.locate(Vec3(std::numeric_limits<double>::quiet_NaN(), 0, 0)), InputError);
}

}  // namespace
}  // namespace polyaffine
