#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <functional>
#include <limits>
#include <polyaffine/core/error.hpp>
#include <polyaffine/mesh/tet_mesh.hpp>

#include "polyaffine/mesh/unit_cube.hpp"
#include "support/error_of.hpp"

namespace polyaffine {
namespace {

using ::testing::AllOf;
using testing::cube_labels;
using testing::error_of;
using ::testing::HasSubstr;
using testing::unit_cube;

TEST(TetMesh, CubeHasItsVolumeBoundaryAndLabels) {
  const auto cube = unit_cube();
  const TetMesh mesh(cube.points, cube.tets, {}, cube_labels());
  EXPECT_NEAR(mesh.volume(), 1, 1e-15);  // six equal sums of products of 0 and 1
  EXPECT_EQ(mesh.boundary().cols(), 12);
  EXPECT_EQ(mesh.surface({1}).cols(), 2);
  EXPECT_EQ(mesh.surface({1, 2}).cols(), 4);
  EXPECT_EQ(mesh.surface_points({2}), (std::vector<int>{4, 5, 6, 7}));
  EXPECT_EQ(std::count(mesh.boundary_labels().begin(), mesh.boundary_labels().end(), TetMesh::kUnlabelled),
            8);
}

TEST(TetMesh, BoundaryPointsOutwards) {
  const auto cube = unit_cube();
  const TetMesh mesh(cube.points, cube.tets);
  for (const auto& face : mesh.boundary().colwise()) {
    const Vec3 a = mesh.points().col(face[0]), b = mesh.points().col(face[1]), c = mesh.points().col(face[2]);
    EXPECT_GT((b - a).cross(c - a).dot((a + b + c) / 3 - Vec3::Constant(0.5)), 0);
  }
}

TEST(TetMesh, NeighboursAreMutualAndShareTheFace) {
  const auto cube = unit_cube();
  const TetMesh mesh(cube.points, cube.tets);
  int open = 0;
  for (int t = 0; t < mesh.num_tets(); ++t)
    for (int k = 0; k < 4; ++k) {
      const int n = mesh.neighbours()(k, t);
      if (n < 0) {
        ++open;
        continue;
      }
      EXPECT_TRUE((mesh.neighbours().col(n).array() == t).any());
      for (int j = 0; j < 4; ++j)
        if (j != k) {
          EXPECT_TRUE((mesh.tets().col(n).array() == mesh.tets()(j, t)).any());
        }
    }
  EXPECT_EQ(open, 12);
}

TEST(TetMesh, WhollyMirroredNumberingIsTurned) {
  auto cube = unit_cube();
  cube.tets.row(0).swap(cube.tets.row(1));
  const TetMesh mesh(cube.points, cube.tets);
  for (int t = 0; t < mesh.num_tets(); ++t) EXPECT_GT(mesh.tet_volume(t), 0);
}

TEST(TetMesh, InvertedTetIsNamed) {
  auto cube = unit_cube();
  std::swap(cube.tets(0, 4), cube.tets(1, 4));
  EXPECT_THAT(error_of([&] { TetMesh(cube.points, cube.tets); }),
              AllOf(HasSubstr("tet 4"), HasSubstr("inverted"), HasSubstr("1 of 6")));
}

TEST(TetMesh, FlatTetIsNamed) {
  auto cube = unit_cube();
  cube.tets.col(2) << 0, 1, 2, 3;
  EXPECT_THAT(error_of([&] { TetMesh(cube.points, cube.tets); }),
              AllOf(HasSubstr("tet 2"), HasSubstr("flat")));
}

TEST(TetMesh, IsolatedPartIsNamed) {
  const auto cube = unit_cube();
  Points points(3, 12);
  points << cube.points, (cube.points.leftCols(4).array() + 5).matrix();
  points.col(11) = Vec3(5, 5, 6);  // points 8, 9, 10 have z = 5
  Tets tets(4, 7);
  tets << cube.tets, Eigen::Vector4i(8, 9, 10, 11);
  EXPECT_THAT(error_of([&] { TetMesh(points, tets); }), AllOf(HasSubstr("tet 6"), HasSubstr("isolated")));
}

TEST(TetMesh, TouchingAtAnEdgeOnlyIsIsolated) {
  Points points(3, 6);
  points << 0, 1, 0, 0, 0, -1,  //
      0, 0, 1, 0, -1, 0,        //
      0, 0, 0, 1, 0, 0;
  Tets tets(4, 2);
  tets.col(0) << 0, 1, 2, 3;
  tets.col(1) << 0, 5, 4, 3;
  EXPECT_THAT(error_of([&] { TetMesh(points, tets); }), HasSubstr("isolated"));
}

TEST(TetMesh, UnusedPointIsNamed) {
  const auto cube = unit_cube();
  Points points(3, 9);
  points << cube.points, Vec3(2, 2, 2);
  EXPECT_THAT(error_of([&] { TetMesh(points, cube.tets); }),
              AllOf(HasSubstr("point 8"), HasSubstr("belongs to no tet")));
}

TEST(TetMesh, LabelOffTheBoundaryIsNamed) {
  const auto cube = unit_cube();
  LabelledTriangles inside{Triangles(3, 1), {9}};
  inside.triangles << 0, 3, 7;  // between the first two tets
  EXPECT_THAT(error_of([&] { TetMesh(cube.points, cube.tets, {}, inside); }),
              AllOf(HasSubstr("label 9"), HasSubstr("not a face of the boundary")));
}

TEST(TetMesh, OtherFaults) {
  const auto cube = unit_cube();
  EXPECT_THAT(error_of([&] { TetMesh(cube.points, Tets(4, 0)); }), HasSubstr("no tetrahedra"));
  EXPECT_THAT(error_of([&] { TetMesh(cube.points, cube.tets, {1, 2}); }), HasSubstr("2 region labels"));
  auto tets = cube.tets;
  tets(2, 3) = 8;
  EXPECT_THAT(error_of([&] { TetMesh(cube.points, tets); }),
              AllOf(HasSubstr("vertex 8"), HasSubstr("0 to 7")));
  auto points = cube.points;
  points(1, 5) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(error_of([&] { TetMesh(points, cube.tets); }), HasSubstr("point 5"));
  Tets twice(4, 7);
  twice << cube.tets, cube.tets.col(0);
  EXPECT_THAT(error_of([&] { TetMesh(cube.points, twice); }), HasSubstr("more than two tets"));
}

}  // namespace
}  // namespace polyaffine
