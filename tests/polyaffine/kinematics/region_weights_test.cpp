#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <polyaffine/core/error.hpp>
#include <polyaffine/geometry/geodesic_regions.hpp>
#include <polyaffine/kinematics/region_weights.hpp>
#include "polyaffine/geometry/box_mesh.hpp"

namespace polyaffine {
namespace {

struct Scene {
  TetMesh mesh = box_mesh(Vec3::Zero(), Vec3(6, 2, 1), {18, 6, 3}, 0.2);
  Matrix distances;

  Scene() {
    const EikonalSolver solver(mesh);
    std::vector<MeshPoint> seeds;
    for (const Vec3& x : {Vec3(1, 1, 0.5), Vec3(3, 0.5, 0.5), Vec3(3, 1.5, 0.5), Vec3(5, 1, 0.5)})
      seeds.push_back(locate(mesh, x));
    distances = normalised_border_distances(solver, voronoi_labels(solver, seeds), 4);
  }
};

void expect_exact_gradients(const Scene& scene, const RegionWeightOptions& options) {
  const RegionWeights weights(scene.mesh, scene.distances, options);
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform(0.1, 1);
  double largest = 0;
  for (int t = 0; t < scene.mesh.num_tets(); t += 97) {
    Vec4 at(uniform(random), uniform(random), uniform(random), uniform(random));
    at /= at.sum();
    const Vec3 x = position(scene.mesh, t, at);
    const RegionWeightValues here = weights.evaluate(t, at);
    EXPECT_NEAR(here.values.sum(), 1, 1e-14);
    EXPECT_GE(here.values.minCoeff(), 0);
    EXPECT_LT(here.gradients.rowwise().sum().norm(), 1e-12);
    for (int k = 0; k < 3; ++k) {
      constexpr double kStep = 1e-5;
      const Vec3 h = kStep * Vec3::Unit(k);
      const Vector difference = (weights.evaluate(t, barycentric(scene.mesh, t, x + h)).values -
                                 weights.evaluate(t, barycentric(scene.mesh, t, x - h)).values) /
                                (2 * kStep);
      // Central difference: step² times third derivatives of order 100.
      EXPECT_LT((difference - here.gradients.row(k).transpose()).norm(), 1e-7);
    }
    largest = std::max(largest, here.gradients.norm());
  }
  EXPECT_GT(largest, 0.5);
}

TEST(RegionWeights, ArePartitionOfUnityWithExactGradients) {
  expect_exact_gradients(Scene(), {});
}

TEST(RegionWeights, WithCompactSupportToo) {
  const Scene scene;
  RegionWeightOptions options;
  options.support = 1.5;
  expect_exact_gradients(scene, options);
  const RegionWeights compact(scene.mesh, scene.distances, options);
  const RegionWeightValues left =
      compact.evaluate(locate(scene.mesh, Vec3(0.2, 1, 0.5)).tet, Vec4::Constant(0.25));
  EXPECT_EQ(left.values[3], 0);
  EXPECT_EQ(left.gradients.col(3).norm(), 0);
  EXPECT_GT(left.values[0], 0.8);
}

TEST(RegionWeights, TakeTheSigmoidValuesBetweenTwoMirrorImages) {
  const TetMesh mesh = box_mesh(Vec3::Zero(), Vec3(4, 1, 1), {8, 2, 2});
  std::vector<int> label(mesh.num_tets());
  for (int t = 0; t < mesh.num_tets(); ++t) label[t] = mesh.tet_centroid(t)[0] < 2 ? 0 : 1;
  const RegionWeights weights(mesh, normalised_border_distances(EikonalSolver(mesh), label, 2));
  for (const double x : {0.0, 1.0, 2.0, 3.0}) {  // d = (x − 2)/2, −d: the sigmoids sum to one by themselves
    const MeshPoint at = locate(mesh, Vec3(x, 0.5, 0.5));
    EXPECT_NEAR(weights.evaluate(at.tet, at.barycentric).values[0], 1 / (1 + std::exp(2.25 * (x - 2) / 2)),
                1e-9);
  }
}

TEST(RegionWeights, RejectBadInput) {
  const TetMesh mesh = box_mesh(Vec3::Zero(), Vec3::Ones(), {1, 1, 1});
  EXPECT_THROW(RegionWeights(mesh, Matrix::Zero(2, 3)), InputError);
  EXPECT_THROW(RegionWeights(mesh, Matrix::Constant(2, 8, INFINITY)), InputError);
  RegionWeightOptions options;
  options.sharpness = 0;
  EXPECT_THROW(RegionWeights(mesh, Matrix::Zero(2, 8), options), InputError);
  options = {};
  options.support = 1;
  EXPECT_THROW(RegionWeights(mesh, Matrix::Constant(2, 8, 2), options).evaluate(0, Vec4::Constant(0.25)),
               ComputationError);
}

}  // namespace
}  // namespace polyaffine
