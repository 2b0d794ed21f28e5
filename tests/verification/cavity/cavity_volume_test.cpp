#include <gtest/gtest.h>

#include <algorithm>

#include <polyaffine/kinematics/lagrange.hpp>
#include <polyaffine/material/signed_volume.hpp>
#include <polyaffine/mesh/surface.hpp>
#include <polyaffine/system/field_energy.hpp>
#include <polyaffine/vtk/read.hpp>

#include "support/random_vector.hpp"

namespace polyaffine {
namespace {

constexpr int kEndo = 1, kBase = 3;

// Two ways to one volume: points of an energy on the endocardium with the cone from the rim to a fixed point
// of its plane, and the closed polyhedron of the deformed vertices. They agree as long as the rim stays in
// place.
TEST(CavityVolume, EnergyAndPolyhedronAgree) {
  const TetMesh mesh = read_vtu(PROJECT_DIR "/meshes/land_ellipsoid_coarse.vtu", 1);
  const LagrangeBasis basis(mesh, 1);
  const EnclosedVolume polyhedron(mesh, {kEndo});
  ASSERT_EQ(polyhedron.rims().size(), 1U);
  const std::vector<int>& rim = polyhedron.rims().front();
  const Vec3 centre = mesh.points()(Eigen::all, rim).rowwise().mean();

  SurfacePoints points = basis.surface_points(mesh, {kEndo}, 1);
  points.X_xi.swap(points.X_eta);  // the boundary points out of the wall, the volume needs out of the cavity
  const FieldEnergy energy(surface_table(basis, points, centre), {std::make_shared<SignedVolume>(1.0 / 3)});

  const std::vector<int> base = mesh.surface_points({kBase});
  for (const unsigned seed : {0U, 1U, 2U}) {
    Points u =
        0.3 * seed * testing::random_vector(3 * mesh.num_points(), 1, seed).reshaped(3, mesh.num_points());
    for (const int p : base) u.col(p).setZero();
    const EnergyValue at = energy.evaluate({u.reshaped()});
    const Points x = mesh.points() + u;
    const double volume = polyhedron.value(x);
    EXPECT_GT(volume, 1000);  // mm³; the smooth shape holds 2296
    EXPECT_NEAR(at.value, volume, 1e-10 * volume);

    const Points forces = at.gradient.reshaped(3, mesh.num_points());
    const Points gradient = polyhedron.gradient(x);
    EXPECT_GT(gradient.norm(), 10);
    Points difference = forces - gradient;
    // The centre of the polyhedron's lid follows the rim: across the lid's plane the rim's derivatives
    // differ.
    for (const int p : rim) difference(2, p) = 0;
    EXPECT_LT(difference.cwiseAbs().maxCoeff(), 1e-10 * gradient.cwiseAbs().maxCoeff());
  }
}

TEST(CavityVolume, CurvedElementsComeCloserToTheEllipsoid) {
  const TetMesh mesh = read_vtu(PROJECT_DIR "/meshes/land_ellipsoid_coarse.vtu", 1);
  // Half an ellipsoid with semi-axes 7 and 17 up to z = 5: π a² (2c/3 + z − z³/(3c²)).
  const double exact = kPi * 49 * (2 * 17.0 / 3 + 5 - 125 / (3 * 17.0 * 17.0));
  const auto volume = [&](const LagrangeBasis& basis) {
    SurfacePoints points = basis.surface_points(mesh, {kEndo}, 4);
    points.X_xi.swap(points.X_eta);
    const FieldEnergy energy(surface_table(basis, points, Vec3(0, 0, 5)),
                             {std::make_shared<SignedVolume>(1.0 / 3)});
    return energy.evaluate({Vector::Zero(3 * basis.num_functions())}).value;
  };
  const double flat = volume(LagrangeBasis(mesh, 1));
  const double curved = volume(LagrangeBasis(mesh, 2, smooth_midpoints(mesh)));
  EXPECT_LT(flat, exact);  // chords of a convex cavity
  EXPECT_LT(std::abs(curved - exact), std::abs(flat - exact) / 5);
}

}  // namespace
}  // namespace polyaffine
