#include <gtest/gtest.h>

#include <memory>

#include <polyaffine/linear/projection.hpp>
#include <polyaffine/material/linear_elastic.hpp>
#include <polyaffine/material/springs.hpp>
#include <polyaffine/quadrature/nearest_weights.hpp>
#include <polyaffine/solve/newton.hpp>
#include <polyaffine/system/field_term.hpp>

#include "support/random_regions.hpp"

namespace polyaffine {
namespace {

constexpr double kYoung = 10, kPoisson = 0.3, kPressure = 1;  // kPa

using Laws = std::vector<std::shared_ptr<const Law>>;

// A cube between two opposite pressures, standing on three corners: u = (ν x, ν y, −z) pressure / E.
struct Patch {
  testing::RandomRegions regions;
  FieldTable table;
  WeightConditions constraint;
  System problem;
  DisplacementMap map;
  Points exact;

  explicit Patch(unsigned seed)
      : regions(5, 150, seed),
        table(deformation_table(*regions.basis, regions.points())),
        constraint(integration_constraint(table, boundary_integrals(*regions.basis, regions.boundary()))),
        map(*regions.basis, regions.boundary().tet, regions.boundary().barycentric) {
    problem = field_system(table.num_unknowns(), {nullptr});  // for the body, whose weights vary
    for (const int side : {-1, 1}) {
      const int label = side < 0 ? testing::kZLow : testing::kZHigh;
      const SurfacePoints face = regions.geometry->surface_points(regions.mesh, {label}, 4);
      problem.terms.push_back(load(std::make_shared<FieldEnergy>(
          displacement_table(*regions.basis, face),
          Laws{std::make_shared<DeadTraction>(Vec3(0, 0, -side * kPressure))})));
    }
    exact = Vec3(kPoisson, kPoisson, -1).asDiagonal() * regions.boundary().X * (kPressure / kYoung);
    support();
  }

  // u(0,0,0) = 0, u_y = u_z = 0 at (1,0,0), u_z = 0 at (0,1,0).
  void support() {
    std::vector<int> tets;
    Eigen::Matrix4Xd barycentric(4, 3);
    for (int k = 0; k < 3; ++k) {
      const MeshPoint at = locate(regions.mesh, k == 0 ? Vec3::Zero() : Vec3(Vec3::Unit(k - 1)));
      tets.push_back(at.tet);
      barycentric.col(k) = at.barycentric;
    }
    const LinearConstraints all =
        displacement_constraints(*regions.basis, tets, barycentric, Points::Zero(3, 3));
    const std::vector<int> rows{0, 1, 2, 4, 5, 8};
    problem.projection = std::make_shared<const Projection>(project({all.C(rows, Eigen::all), all.d(rows)}));
  }

  // Largest error of the displacement of the boundary relative to the shortening.
  double error(const Vector& weights) {
    FieldTable weighted = table;
    weighted.weights = weights;
    problem.terms[0] = solid(std::make_shared<FieldEnergy>(
        weighted, Laws{std::make_shared<LinearElastic>(Elasticity{kYoung, kPoisson})}));
    Vector c = Vector::Zero(table.num_unknowns());
    EXPECT_TRUE(newton(problem, 1, *problem.make_linear(), c, {.tolerance = 1e-12}).converged());
    return (map.apply(c) - exact).cwiseAbs().maxCoeff() * kYoung / kPressure;
  }
};

class RandomPatch : public ::testing::TestWithParam<unsigned> {};

TEST_P(RandomPatch, UniformStressIsASolutionOnlyWithTheIntegrationConstraint) {
  Patch patch(GetParam());
  const Vector& volumes = patch.regions.integration.points.weights;
  EXPECT_GT(patch.error(volumes), 1e-3);

  const NearestWeights consistent = nearest_weights(patch.constraint, volumes);
  ASSERT_TRUE(consistent.met);
  EXPECT_GE(consistent.weights.minCoeff(), 0);
  EXPECT_NEAR(consistent.weights.sum(), 1, 1e-12);  // follows: affine maps are among the functions
  EXPECT_LT(patch.error(consistent.weights), 1e-10);

  const WeightConditions with_moments = stack(
      patch.constraint, region_moments(patch.regions.mesh, patch.regions.label, 5, patch.regions.points().tet,
                                       positions(patch.regions.mesh, patch.regions.integration.points)));
  const NearestWeights both = nearest_weights(with_moments, volumes);
  ASSERT_TRUE(both.met);
  EXPECT_LT(patch.error(both.weights), 1e-10);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomPatch, ::testing::Values(1U, 2U, 3U));

}  // namespace
}  // namespace polyaffine
