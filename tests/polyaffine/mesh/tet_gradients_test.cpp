#include <gtest/gtest.h>

#include <Eigen/LU>

#include <polyaffine/mesh/tet_gradients.hpp>

#include "polyaffine/mesh/unit_cube.hpp"

namespace polyaffine {
namespace {

TetMesh cube() {
  const testing::CubeParts parts = testing::unit_cube();
  return {parts.points, parts.tets};
}

TEST(TetGradients, AreThoseOfAnAffineMotion) {
  const TetMesh mesh = cube();
  Mat3 F;
  F << 1.2, 0.3, 0, -0.1, 0.9, 0.2, 0, 0.1, 1.1;
  const Points moved = (F * mesh.points()).colwise() + Vec3(3, -2, 1);
  for (const auto& list : {tet_gradients(mesh, moved), vertex_gradients(mesh, moved)})
    for (const Mat3& at : list) EXPECT_LT((at - F).norm(), 1e-13);
  EXPECT_NEAR(least_volume_ratio(mesh, moved), F.determinant(), 1e-13);
}

TEST(TetGradients, TellATetThatTurnsInsideOut) {
  const TetMesh mesh = cube();
  Points moved = mesh.points();
  moved.col(0) += 10 * (mesh.tet_centroid(0) - moved.col(0));
  EXPECT_LT(least_volume_ratio(mesh, moved), 0);
  EXPECT_DOUBLE_EQ(least_volume_ratio(mesh, mesh.points()), 1);
}

}  // namespace
}  // namespace polyaffine
