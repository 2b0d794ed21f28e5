#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <polyaffine/core/error.hpp>
#include <polyaffine/geometry/locate.hpp>
#include "polyaffine/geometry/box_mesh.hpp"

namespace polyaffine {
namespace {

TEST(Locate, FindsInsideAndClosestOutside) {
  const TetMesh mesh = box_mesh(Vec3::Zero(), Vec3(2, 1, 1), {4, 3, 3}, 0.2);
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> uniform(-0.5, 2.5);
  for (int i = 0; i < 200; ++i) {
    const Vec3 x(uniform(random), uniform(random), uniform(random));
    const Vec3 closest = x.cwiseMax(Vec3::Zero()).cwiseMin(Vec3(2, 1, 1));
    const MeshPoint found = locate(mesh, x);
    EXPECT_NEAR(found.distance, (x - closest).norm(), 1e-12);
    EXPECT_LT((position(mesh, found.tet, found.barycentric) - closest).norm(), 1e-12);
    EXPECT_GE(found.barycentric.minCoeff(), 0);
  }
  const MeshPoint nearest = locate(mesh, Vec3(1, 0.5, 0.5), {0});  // the first tet lies in the corner cell
  EXPECT_EQ(nearest.tet, 0);
  EXPECT_NEAR(nearest.distance, (position(mesh, 0, nearest.barycentric) - Vec3(1, 0.5, 0.5)).norm(), 1e-14);
  EXPECT_GT(nearest.distance, 0.3);
  EXPECT_THROW(locate(mesh, Vec3::Zero(), std::vector<int>{}), InputError);
  EXPECT_THROW(locate(mesh, Vec3(std::nan(""), 0, 0)), InputError);
}

}  // namespace
}  // namespace polyaffine
