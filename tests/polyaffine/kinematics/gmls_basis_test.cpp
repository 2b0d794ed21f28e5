#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

#include <polyaffine/core/error.hpp>
#include <polyaffine/kinematics/gmls_basis.hpp>

#include "support/random_regions.hpp"
#include "support/random_vector.hpp"

namespace polyaffine {
namespace {

constexpr double kLength = 0.4;  // mm

struct Scene {
  testing::RandomRegions regions{5, 20, 2};
  Points nodes{3, 5};
  std::shared_ptr<const GmlsBasis> basis;

  explicit Scene(double support = std::numeric_limits<double>::infinity()) {
    for (int i = 0; i < 5; ++i) nodes.col(i) = regions.nodes[i].position;
    const Matrix distances = normalised_border_distances(EikonalSolver(regions.mesh), regions.label, 5);
    basis = std::make_shared<GmlsBasis>(
        regions.mesh,
        std::make_shared<RegionWeights>(regions.mesh, distances, RegionWeightOptions{.support = support}),
        nodes, kLength);
  }
};

TEST(GmlsBasis, ReproducesAffineMapsAndTheirGradients) {
  const Scene scene;
  EXPECT_EQ(scene.basis->num_functions(), 20);
  const Mat3 a = testing::random_vector(9, 1, 5).reshaped(3, 3);
  const Vec3 t(3, -2, 7);
  Vector c(60);
  for (int i = 0; i < 5; ++i) {
    c.segment<3>(12 * i) = a * scene.nodes.col(i) + t;
    c.segment<9>(12 * i + 3) = kLength * a.reshaped();
  }
  const WallPoints points = scene.regions.points();
  const FieldTable table = deformation_table(*scene.basis, points);
  const Points u = DisplacementMap(*scene.basis, points.tet, points.barycentric).apply(c);
  const Points X = positions(scene.regions.mesh, scene.regions.integration.points);
  EXPECT_LT(((a * X).colwise() + t - u).norm(), 1e-12);
  const Matrix F = evaluate_field(table, c);
  EXPECT_LT((F.colwise() - Vector((Mat3::Identity() + a).reshaped())).norm(), 1e-11);
}

TEST(GmlsBasis, GradientsMatchFiniteDifferencesInsideATet) {
  const Scene scene;
  const TetMesh& mesh = scene.regions.mesh;
  for (const int tet : {3, 200, 555}) {
    const Vec3 x = mesh.tet_centroid(tet);
    const BasisSample at = scene.basis->sample(tet, Vec4::Constant(0.25));
    for (int k = 0; k < 3; ++k) {
      constexpr double kStep = 1e-5;  // mm, against tets of 0.1
      const auto value = [&](double h) {
        return scene.basis->sample(tet, barycentric(mesh, tet, x + h * Vec3::Unit(k))).N;
      };
      const Vector difference = (value(kStep) - value(-kStep)) / (2 * kStep);
      EXPECT_LT((difference - at.gradient.row(k).transpose()).norm(), 1e-7);
      EXPECT_GT(difference.norm(), 0.1);
    }
  }
}

TEST(GmlsBasis, LeavesOutNodesBeyondTheirSupport) {
  const Scene everywhere, compact(0.6);
  std::size_t fewest = 20;
  for (int t = 0; t < compact.regions.mesh.num_tets(); t += 50) {
    fewest = std::min(fewest, compact.basis->sample(t, Vec4::Constant(0.25)).functions.size());
    EXPECT_EQ(everywhere.basis->sample(t, Vec4::Constant(0.25)).functions.size(), 20);
  }
  EXPECT_LT(fewest, 20);
}

TEST(GmlsBasis, RejectsAnotherNumberOfNodes) {
  const Scene scene;
  EXPECT_THROW(GmlsBasis(scene.regions.mesh, scene.regions.weights, Points::Zero(3, 4), 1), InputError);
  EXPECT_THROW(GmlsBasis(scene.regions.mesh, scene.regions.weights, scene.nodes, 0), InputError);
}

}  // namespace
}  // namespace polyaffine
