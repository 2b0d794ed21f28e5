#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <polyaffine/kinematics/lagrange.hpp>
#include <polyaffine/linear/sparse_system.hpp>
#include <polyaffine/material/neo_hookean.hpp>
#include <polyaffine/material/signed_volume.hpp>
#include <polyaffine/material/springs.hpp>
#include <polyaffine/rules/gauss.hpp>
#include <polyaffine/solve/load_stepping.hpp>
#include <polyaffine/system/field_term.hpp>
#include <polyaffine/system/support.hpp>

#include "support/labelled_box.hpp"
#include "support/sphere_midpoints.hpp"

namespace polyaffine {
namespace {

constexpr double kInner = 1, kOuter = 2;  // mm
constexpr double kMu = 10, kKappa = 1e5;  // kPa; κ/μ so large that the volume changes by 10⁻⁴ only
constexpr double kInflated = 1.2;         // deformed inner radius, mm

// Radius of the incompressible sphere: r³ − a³ = R³ − A³.
double radius(double R) {
  return std::cbrt(R * R * R - std::pow(kInner, 3) + std::pow(kInflated, 3));
}

// Pressure inside the incompressible neo-Hookean sphere, p = ∫ 2 (σ_θ − σ_r) dr/r with σ_θ − σ_r = μ (s² −
// s⁻⁴), s = r/R, dr = R²/r² dR.
double pressure() {
  const LineRule rule = line_rule(20);
  double p = 0;
  for (Eigen::Index q = 0; q < rule.points.size(); ++q) {
    const double R = kInner + (kOuter - kInner) * rule.points[q];
    const double r = radius(R);
    const double s = r / R;
    p += rule.weights[q] * (kOuter - kInner) * 2 * kMu * (s * s - std::pow(s, -4)) * R * R / (r * r * r);
  }
  return p;
}

struct Solution {
  double inner, outer;  // mean deformed radii, mm
  double spread;        // largest difference from them
};

// A 24th of the sphere: the planes y = 0 and z = 0 by fixed unknowns, y = x and z = x by stiff springs along
// the normal.
Solution inflate(int cells) {
  const TetMesh mesh =
      testing::mapped(testing::labelled_box(Vec3(kInner, 0, 0), Vec3(kOuter, 1, 1), {cells, cells, cells}),
                      testing::to_sphere);
  const LagrangeBasis basis(mesh, 2, testing::sphere_midpoints(mesh));
  const FieldTable table = deformation_table(basis, basis.wall_points(4));
  using Laws = std::vector<std::shared_ptr<const Law>>;
  const auto wall = std::make_shared<FieldEnergy>(table, Laws{std::make_shared<IsochoricNeoHookean>(kMu)},
                                                  block_pressure(table, kKappa));
  System problem = field_system(table.num_unknowns(), {solid(wall)});

  SurfacePoints inside = basis.surface_points(mesh, {testing::kXLow}, 4);
  inside.X_xi.swap(inside.X_eta);  // out of the cavity
  const auto cavity = std::make_shared<FieldEnergy>(surface_table(basis, inside, Vec3::Zero()),
                                                    Laws{std::make_shared<SignedVolume>(1.0 / 3)});
  // The 24th of a sphere of radius A, but for the faces that quadratic elements cannot follow.
  EXPECT_NEAR(cavity->evaluate({Vector::Zero(table.num_unknowns())}).value, 4 * kPi / 72, 2e-3);
  const double p = pressure();
  problem.terms.push_back(load(cavity, [p](double t) { return -t * p; }));

  for (const int side : {testing::kYHigh, testing::kZHigh}) {
    const SurfacePoints points = basis.surface_points(mesh, {side}, 4);
    const Vec3 normal = side == testing::kYHigh ? Vec3(-1, 1, 0).normalized() : Vec3(-1, 0, 1).normalized();
    problem.terms.push_back(std::make_shared<Support>(
        displacement_table(basis, points),
        SupportParameters{.stiffness_kPa_per_mm = 1e6, .normals = normal.replicate(1, points.X.cols())}));
  }
  problem.fixed.assign(table.num_unknowns(), 0);
  for (const int node : basis.surface_nodes(mesh, {testing::kYLow})) problem.fixed[3 * node + 1] = 1;
  for (const int node : basis.surface_nodes(mesh, {testing::kZLow})) problem.fixed[3 * node + 2] = 1;

  Vector c = Vector::Zero(table.num_unknowns());
  LoadOptions options;
  options.first_step = 0.5;
  const LoadReport report = load_stepping(problem, *sparse_system({&table}, problem.fixed), c, options);
  EXPECT_TRUE(report.converged());
  const Points x = basis.nodes() + Points(c.reshaped(3, basis.num_functions()));
  Solution out{0, 0, 0};
  for (const int face : {testing::kXLow, testing::kXHigh}) {
    const std::vector<int> nodes = basis.surface_nodes(mesh, {face});
    const Vector r = x(Eigen::all, nodes).colwise().norm().transpose();
    (face == testing::kXLow ? out.inner : out.outer) = r.mean();
    out.spread = std::max(out.spread, (r.array() - r.mean()).abs().maxCoeff());
  }
  return out;
}

TEST(ThickSphere, InflatesAsTheAnalyticSolutionSays) {
  const Solution coarse = inflate(2);
  const Solution fine = inflate(3);
  EXPECT_NEAR(coarse.inner, kInflated, 0.005 * (kInflated - kInner));
  EXPECT_NEAR(fine.inner, kInflated, 0.001 * (kInflated - kInner));
  EXPECT_NEAR(fine.outer, radius(kOuter), 0.003 * (radius(kOuter) - kOuter));
  // (2/3)² and more; the volume change and the springs leave about 10⁻⁵.
  EXPECT_LT(std::abs(fine.inner - kInflated), 0.6 * std::abs(coarse.inner - kInflated));
  EXPECT_LT(fine.spread, 0.002);
  EXPECT_LT(fine.spread, 0.6 * coarse.spread);
}

}  // namespace
}  // namespace polyaffine
