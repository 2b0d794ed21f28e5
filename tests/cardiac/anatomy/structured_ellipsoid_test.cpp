#include <gtest/gtest.h>

#include <cmath>

#include <cardiac/anatomy/structured_ellipsoid.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/kinematics/lagrange.hpp>
#include <polyaffine/mesh/surface.hpp>

namespace cardiac {
namespace {

double curved_volume(const CurvedMesh& m) {
  return polyaffine::LagrangeBasis(m.mesh, 2, m.midpoints).wall_points(5).weights.sum();
}

TEST(StructuredEllipsoid, FillsTheWallAndConverges) {
  const double exact = exact_wall_volume(land_ellipsoid());
  const CurvedMesh coarse = structured_ellipsoid(land_ellipsoid(), {4, 8, 1});
  const CurvedMesh fine = structured_ellipsoid(land_ellipsoid(), {8, 16, 2});
  EXPECT_EQ(coarse.mesh.num_tets(), (2 * 3 + 1) * 8 * 3);
  EXPECT_EQ(coarse.mesh.num_points(), 2 * (4 * 8 + 1));
  EXPECT_LT(std::abs(curved_volume(coarse) / exact - 1), 0.005);
  // Quadratic edges follow the surface to fourth order; twice the cells, sixteen times nearer.
  EXPECT_LT(std::abs(curved_volume(fine) - exact), std::abs(curved_volume(coarse) - exact) / 10);
}

TEST(StructuredEllipsoid, LabelsItsSurface) {
  const auto shape = land_ellipsoid();
  const CurvedMesh m = structured_ellipsoid(shape, {3, 6, 2});
  EXPECT_EQ(m.mesh.surface({kBase}).cols(), 6 * 2 * 2);
  EXPECT_EQ(m.mesh.surface({polyaffine::TetMesh::kUnlabelled}).cols(), 0);
  for (const int label : {kEndocardium, kEpicardium, kBase})
    for (const int p : m.mesh.surface_points({label})) {
      const Vec3 X = m.mesh.points().col(p);
      EXPECT_LT((project_to_surface(shape, label, X) - X).norm(), 1e-9);
    }
  for (const auto& [edge, X] : m.midpoints) EXPECT_LT(wall_function(shape, X), 1e-9);
  // The endocardium has one rim, as a cavity needs.
  EXPECT_EQ(polyaffine::rim_loops(m.mesh.surface({kEndocardium})).size(), 1);
}

TEST(StructuredEllipsoid, RefusesCellsThatMakeNoWall) {
  for (const StructuredCells& cells : {StructuredCells{1, 6, 1}, StructuredCells{3, 7, 1},
                                       StructuredCells{3, 2, 1}, StructuredCells{3, 6, 0}})
    EXPECT_THROW(structured_ellipsoid(land_ellipsoid(), cells), polyaffine::InputError);
}

}  // namespace
}  // namespace cardiac
