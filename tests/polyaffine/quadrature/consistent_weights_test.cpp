#include <gtest/gtest.h>

#include <polyaffine/quadrature/consistent_weights.hpp>

#include "support/random_regions.hpp"

namespace polyaffine {
namespace {

struct Scene {
  testing::RandomRegions regions;
  WeightConditions constraint, moments;

  explicit Scene(int points) : regions(5, points, 7) {
    const WallPoints wall = regions.points();
    constraint = integration_constraint(deformation_table(*regions.basis, wall),
                                        boundary_integrals(*regions.basis, regions.boundary()));
    moments = region_moments(regions.mesh, regions.label, 5, wall.tet,
                             positions(regions.mesh, regions.integration.points));
  }
  ConsistentWeights solve() const {
    return consistent_weights(constraint, moments, regions.integration.points.weights);
  }
  double miss(const WeightConditions& c, const Vector& w) const {
    return (c.A * w - c.b).cwiseAbs().cwiseQuotient(c.scale).maxCoeff();
  }
};

TEST(ConsistentWeights, MeetTheConstraintAndKeepEveryRegion) {
  const Scene scene(300);
  const ConsistentWeights found = scene.solve();
  EXPECT_TRUE(found.met);
  EXPECT_TRUE(found.moments);
  EXPECT_GE(found.weights.minCoeff(), 0);
  EXPECT_GT(scene.miss(scene.constraint, scene.regions.integration.points.weights), 1e-4);
  EXPECT_LT(scene.miss(scene.constraint, found.weights), 1e-12);
  EXPECT_LT(scene.miss(scene.moments, found.weights), 1e-12);
}

// 60 conditions of the constraint and 20 of the moments on 110 points.
TEST(ConsistentWeights, GiveUpTheMomentsBeforeTheConstraint) {
  const Scene scene(110);
  const ConsistentWeights found = scene.solve();
  EXPECT_TRUE(found.met);
  EXPECT_FALSE(found.moments);
  EXPECT_GE(found.weights.minCoeff(), 0);
  EXPECT_LT(scene.miss(scene.constraint, found.weights), 1e-12);
  EXPECT_GT(scene.miss(scene.moments, found.weights), 1e-6);
}

TEST(ConsistentWeights, SayThatThereAreTooFewPoints) {
  const ConsistentWeights found = Scene(40).solve();
  EXPECT_FALSE(found.met);
  EXPECT_FALSE(found.moments);
}

}  // namespace
}  // namespace polyaffine
