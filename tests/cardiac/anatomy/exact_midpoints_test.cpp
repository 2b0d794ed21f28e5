#include <gtest/gtest.h>

#include <cardiac/anatomy/exact_midpoints.hpp>
#include <cmath>
#include <polyaffine/core/error.hpp>
#include <polyaffine/kinematics/lagrange.hpp>

#include "support/labelled_box.hpp"
#include "support/land_ellipsoid.hpp"

namespace cardiac {
namespace {

const auto kShape = land_ellipsoid();

TEST(ExactMidpoints, LieOnTheSurfaceOfTheirLabel) {
  const auto& mesh = testing::LandEllipsoid::get().mesh;
  const auto midpoints = exact_midpoints(kShape, mesh);
  int on_rim = 0;
  for (Eigen::Index f = 0; f < mesh.boundary().cols(); ++f)
    for (int k = 0; k < 3; ++k) {
      const Vec3 x = midpoints.at(std::minmax(mesh.boundary()(k, f), mesh.boundary()((k + 1) % 3, f)));
      const int label = mesh.boundary_labels()[f];
      EXPECT_LT((project_to_surface(kShape, label, x) - x).norm(), 1e-10);
      on_rim += label == kBase && (project_to_rim(kShape, kEndocardium, x) - x).norm() < 1e-10;
    }
  EXPECT_GT(on_rim, 10);
}

TEST(ExactMidpoints, QuadraticElementsHoldTheExactVolume) {
  const auto& mesh = testing::LandEllipsoid::get().mesh;
  const auto volume = [&](const polyaffine::LagrangeBasis& basis) {
    return basis.wall_points(6).weights.sum() / exact_wall_volume(kShape) - 1;
  };
  const double flat = volume(polyaffine::LagrangeBasis(mesh, 1));
  EXPECT_LT(std::abs(volume(polyaffine::LagrangeBasis(mesh, 2, exact_midpoints(kShape, mesh)))),
            0.05 * std::abs(flat));
}

TEST(ExactMidpoints, AnotherLabelIsAnError) {
  EXPECT_THROW(exact_midpoints(kShape, polyaffine::testing::labelled_cube(1)), polyaffine::InputError);
}

}  // namespace
}  // namespace cardiac
