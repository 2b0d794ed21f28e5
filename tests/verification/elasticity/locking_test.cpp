#include <gtest/gtest.h>

#include <cmath>

#include <polyaffine/kinematics/lagrange.hpp>
#include <polyaffine/linear/sparse_system.hpp>
#include <polyaffine/material/neo_hookean.hpp>
#include <polyaffine/material/springs.hpp>
#include <polyaffine/solve/newton.hpp>
#include <polyaffine/system/field_term.hpp>

#include "support/labelled_box.hpp"

namespace polyaffine {
namespace {

constexpr double kYoung = 10;       // kPa
constexpr double kTraction = 1e-3;  // kPa: a deflection of a few per cent of the thickness

// Deflection of the end of a clamped beam of 5 × 1 × 1 mm under a shear traction there, with one mean
// dilatation an element.
double deflection(double poisson, int order, int cells) {
  const TetMesh mesh = testing::labelled_box(Vec3::Zero(), Vec3(5, 1, 1), {5 * cells, cells, cells});
  const LagrangeBasis basis(mesh, order);
  const Lame l = lame({kYoung, poisson});
  const FieldTable table = deformation_table(basis, basis.wall_points(order == 1 ? 1 : 3));
  const PressureSpace space = block_pressure(table, l.lambda + 2 * l.mu / 3);
  using Laws = std::vector<std::shared_ptr<const Law>>;
  const auto wall =
      std::make_shared<FieldEnergy>(table, Laws{std::make_shared<IsochoricNeoHookean>(l.mu)}, space);
  const auto load = std::make_shared<FieldEnergy>(
      displacement_table(basis, basis.surface_points(mesh, {testing::kXHigh}, 2)),
      Laws{std::make_shared<DeadTraction>(Vec3(0, 0, kTraction))});
  System problem = field_system(3 * basis.num_functions(), {solid(wall), polyaffine::load(load)});
  problem.fixed.assign(3 * basis.num_functions(), 0);
  for (const int node : basis.surface_nodes(mesh, {testing::kXLow}))
    for (int k = 0; k < 3; ++k) problem.fixed[3 * node + k] = 1;
  Vector c = Vector::Zero(3 * basis.num_functions());
  EXPECT_TRUE(newton(problem, 1, *sparse_system({&table}, problem.fixed), c).converged());
  return -load->evaluate({c}).value / kTraction;  // ∫ u_z over the end, 1 mm²
}

// Bernoulli's beam with Timoshenko's shear, F L³/(3 E I) + F L/(k G A), for a square section of 1 mm².
double beam(double poisson) {
  const double shear_factor = 5.0 / 6;
  return kTraction * (125 / (3 * kYoung / 12) + 5 / (shear_factor * kYoung / (2 * (1 + poisson))));
}

TEST(Locking, QuadraticElementsWithMeanDilatationBendAtEveryPoissonRatio) {
  for (const double poisson : {0.3, 0.45, 0.49, 0.499, 0.4999}) {
    const double coarse = deflection(poisson, 2, 1) / beam(poisson);
    const double fine = deflection(poisson, 2, 2) / beam(poisson);
    // A constant pressure does not see the dilatation that changes sign within an element: a single element
    // through the thickness bends too easily, by the same amount at every ratio, and two of them are close.
    EXPECT_NEAR(fine, 1, 0.07) << poisson;
    EXPECT_LT(std::abs(fine - 1), std::abs(coarse - 1) / 4) << poisson;
  }
}

TEST(Locking, LinearElementsLock) {
  // One volume constraint an element against fewer than one vertex: this test sees locking where there is
  // some.
  EXPECT_GT(deflection(0.3, 1, 2) / beam(0.3), 0.4);
  EXPECT_LT(deflection(0.4999, 1, 2) / beam(0.4999), 0.2);
}

}  // namespace
}  // namespace polyaffine
