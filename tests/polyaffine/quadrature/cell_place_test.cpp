#include "polyaffine/quadrature/cell_place.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include <polyaffine/kinematics/lagrange.hpp>

#include "support/labelled_box.hpp"

namespace polyaffine {
namespace {

struct Cube {
  TetMesh mesh = testing::labelled_cube(3, 0.2);
  LagrangeBasis basis{mesh, 1};
  PlaceOf place_of = [this](int tet, const Vec4& l) {
    const Vec3 X = basis.position(tet, l);
    return CellPlace{X.x() < 0.5 ? 0 : 1, Vec3(std::exp(X.x()), X.y() + 0.1 * std::sin(X.z()), X.z())};
  };
  Vec3 position(const MeshPoint& p) const { return basis.position(p.tet, p.barycentric); }
};

std::vector<MeshPoint> every_element(const TetMesh& mesh) {
  std::vector<MeshPoint> out;
  for (int t = 0; t < mesh.num_tets(); ++t) out.push_back({t, Vec4::Constant(0.25)});
  return out;
}

TEST(CellPlace, FindsThePointOfAPlaceInTheElementThatHoldsIt) {
  const Cube cube;
  const Vec3 X(0.31, 0.62, 0.17);
  const CellPlace wanted{0, Vec3(std::exp(X.x()), X.y() + 0.1 * std::sin(X.z()), X.z())};
  const auto found = find_place(cube.place_of, wanted, every_element(cube.mesh));
  ASSERT_TRUE(found);
  EXPECT_LT((cube.position(*found) - X).norm(), 1e-8);
  EXPECT_GE(found->barycentric.minCoeff(), -1e-9);
  EXPECT_NEAR(found->barycentric.sum(), 1, 1e-12);
}

TEST(CellPlace, NothingOutsideTheMeshOrInAnotherCell) {
  const Cube cube;
  const auto all = every_element(cube.mesh);
  EXPECT_FALSE(find_place(cube.place_of, {0, Vec3(std::exp(0.3), 0.6, 1.5)}, all));
  EXPECT_FALSE(find_place(cube.place_of, {1, Vec3(std::exp(0.3), 0.6, 0.5)}, all));
  EXPECT_FALSE(find_place(cube.place_of, {7, Vec3(std::exp(0.3), 0.6, 0.5)}, all));
  EXPECT_FALSE(find_place(cube.place_of, {0, Vec3(std::exp(0.3), 0.6, 0.5)}, {}));
}

TEST(CellPlace, StaysOnAFace) {
  const Cube cube;
  // Faces of the cube at z = 0, started from their middles.
  std::vector<MeshPoint> faces;
  for (Eigen::Index f = 0; f < cube.mesh.boundary().cols(); ++f) {
    if (cube.mesh.boundary_labels()[f] != testing::kZLow) continue;
    const int tet = cube.mesh.boundary_tets()[f];
    Vec4 l = Vec4::Zero();
    for (int k = 0; k < 4; ++k)
      for (int i = 0; i < 3; ++i)
        if (cube.mesh.tets()(k, tet) == cube.mesh.boundary()(i, f)) l[k] = 1.0 / 3;
    faces.push_back({tet, l});
  }
  const auto found = find_place(cube.place_of, {1, Vec3(std::exp(0.71), 0.44, 123)}, faces);
  ASSERT_TRUE(found);
  EXPECT_LT((cube.position(*found) - Vec3(0.71, 0.44, 0)).norm(), 1e-8);
}

}  // namespace
}  // namespace polyaffine
