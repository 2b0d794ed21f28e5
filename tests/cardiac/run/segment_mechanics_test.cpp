#include "cardiac/run/segment_mechanics.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include <cardiac/anatomy/structured_ellipsoid.hpp>
#include <cardiac/reduction/reduced_points.hpp>
#include <cardiac/run/build_ventricle.hpp>
#include <cardiac/run/key_states.hpp>
#include <cardiac/run/segment_shares.hpp>
#include <cardiac/run/simulate.hpp>
#include <cardiac/strain/segment_strain.hpp>
#include <polyaffine/kinematics/lagrange.hpp>

namespace cardiac {
namespace {

using polyaffine::Mat3;
using polyaffine::Vector;

std::shared_ptr<const Anatomy> heart(const TruncatedEllipsoid& shape, const StructuredCells& cells) {
  CurvedMesh mesh = structured_ellipsoid(shape, cells);
  return std::make_shared<const Anatomy>(make_anatomy(mesh.mesh, {.midpoints = mesh.midpoints}));
}

// A wall of linear elements that follows an affine map.
struct AffineWall {
  static constexpr double kMu = 4, kBulk = 200;
  Scene scene;
  Ventricle ventricle;

  AffineWall() {
    scene.heart = heart(human_lv(), {8, 16, 1});
    scene.reduction.method = scene::Method::fem;
    scene.reduction.element_order = 1;
    scene.tissue.law = scene::TissueLaw::neo_hookean;
    scene.tissue.mu_kPa = kMu;
    scene.tissue.bulk_modulus_kPa = kBulk;
    scene.fibres.emplace();
    ventricle = build_ventricle(scene.heart, scene, scene.reduction.method);
  }
  HeartState state(double time_ms, const Mat3& F) const {
    Vector c(ventricle.num_coefficients());
    for (int p = 0; p < scene.heart->mesh.num_points(); ++p)
      c.segment<3>(3 * p) = (F - Mat3::Identity()) * scene.heart->mesh.points().col(p);
    return {time_ms, c};
  }
  std::vector<SegmentMechanics> last(const std::vector<Mat3>& path_of, const Mat3& ed) const {
    HeartPath path;
    double t = 0;
    for (const Mat3& F : path_of) path.steps.push_back(state(t++, F));
    path.outputs = {path.steps.back()};
    return segment_mechanics(ventricle, scene, path, state(0, ed).c).front();
  }
};

const AffineWall& wall() {
  static const AffineWall out;
  return out;
}

// Of a bar with free sides: μ J^(−5/3) (λ² − λ_t²) along it, where λ_t makes the sides free of stress.
TEST(SegmentMechanics, VonMisesOfUniaxialStressIsThatStress) {
  const double l = 1.15, mu = AffineWall::kMu, kappa = AffineWall::kBulk;
  const auto side_stress = [&](double side) {
    const double J = l * side * side;
    return mu * std::pow(J, -5.0 / 3) * (side * side - l * l) / 3 + kappa * (J - 1);
  };
  double low = 0.8, high = 1.1;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (side_stress(middle) > 0 ? high : low) = middle;
  }
  const double stress = mu * std::pow(l * low * low, -5.0 / 3) * (l * l - low * low);
  const Mat3 F = polyaffine::Vec3(low, l, low).asDiagonal();
  for (const SegmentMechanics& m : wall().last({Mat3::Identity(), F}, Mat3::Identity())) {
    EXPECT_NEAR(m.von_mises_kPa, stress, 1e-9 * stress);
    EXPECT_NEAR(m.mean_stress_kPa, stress / 3, 1e-8 * stress);
    EXPECT_EQ(m.active_stress_kPa, 0);
    EXPECT_GT(m.fibre_stress_kPa, 0);
    EXPECT_LT(m.fibre_stress_kPa, stress);
  }
}

// The same stress in all directions, also the fibre's: κ (J − 1), and work −∫ κ (J − 1) dJ over the volume.
TEST(SegmentMechanics, OfASwellingWallIsPressure) {
  const double s = 1.01, kappa = AffineWall::kBulk;
  std::vector<Mat3> path;
  for (int n = 0; n <= 20; ++n) path.emplace_back((1 + (s - 1) * n / 20) * Mat3::Identity());
  const double stress = kappa * (s * s * s - 1), density = kappa / 2 * std::pow(s * s * s - 1, 2);
  const auto all = wall().last(path, Mat3::Identity());
  double work = 0;
  for (const SegmentMechanics& m : all) {
    EXPECT_NEAR(m.fibre_stress_kPa, stress, 1e-9 * stress);
    EXPECT_NEAR(m.mean_stress_kPa, stress, 1e-9 * stress);
    EXPECT_NEAR(m.von_mises_kPa, 0, 1e-9 * stress);
    EXPECT_NEAR(m.fibre_strain, s - 1, 1e-12);
    work += m.work_mJ;
  }
  // Trapezoids of 20 steps leave 1e-5 of a work that is nearly of second order in the swelling.
  const Anatomy& heart = *wall().scene.heart;
  double volume = 0;
  for (const double v : segment_volumes(heart.mesh, heart.segment, 17)) volume += v;
  EXPECT_NEAR(work, -1e-3 * density * volume, 1e-3 * 1e-3 * density * volume);
}

TEST(SegmentMechanics, FibreStrainIsThatSinceEndDiastole) {
  const Mat3 ed = 1.2 * Mat3::Identity();
  for (const SegmentMechanics& m : wall().last({Mat3::Identity(), 0.9 * ed}, ed))
    EXPECT_NEAR(m.fibre_strain, -0.1, 1e-12);
}

// Balance of forces on half a sphere under pressure: the mean hoop stress is p r²/(R² − r²) of the deformed
// radii. Fibres go round; apical and middle segments are away from the clamped base.
TEST(SegmentMechanics, FibreStressOfAThinSphereIsLaplaces) {
  const double r = 25, R = 26, pressure = 1;
  Scene scene;
  scene.heart = heart({r, r, R, R, 20}, {14, 20, 1});
  scene.reduction.method = scene::Method::fem;
  scene.tissue.law = scene::TissueLaw::neo_hookean;
  scene.tissue.mu_kPa = 100;
  scene.tissue.bulk_modulus_kPa = 1e5;
  scene.fibres.emplace();
  scene.fibres->endo_angle_deg = scene.fibres->epi_angle_deg = 0;
  scene.cavities.emplace();
  scene.cavities->pressure_kPa = pressure;
  scene.time.load_steps = 2;
  scene.output.mechanics = true;
  const Outcome outcome = simulate(scene, {.keep_absurd = true});
  ASSERT_TRUE(outcome.result.completed) << outcome.result.stop_reason;
  const auto& mechanics = outcome.result.instants.back().mechanics;
  ASSERT_EQ(mechanics.size(), 17U);
  // u/r = p r/(2 h) / (6 μ) of a thin sphere in small strain, by which the radii grow and the wall thins.
  const double middle = (r + R) / 2, grown = 1 + pressure * middle / 2 / (R - r) / 600;
  const double inner = grown * middle - (R - r) / 2 / grown / grown,
               outer = grown * middle + (R - r) / 2 / grown / grown;
  const double hoop = pressure * inner * inner / (outer * outer - inner * inner);
  for (std::size_t k = 6; k < 16; ++k) EXPECT_NEAR(mechanics[k].fibre_stress_kPa, hoop, 0.02 * hoop) << k + 1;
}

// A beat of a coarse human ventricle, reduced.
const Scene& beating() {
  static const Scene out = [] {
    Scene scene;
    scene.heart = heart(human_lv(), {8, 16, 1});
    scene.fibres.emplace();
    scene.activation.emplace();
    scene.contraction.emplace();
    scene.circulation.emplace();
    scene.time.max_beats = 1;
    scene.output.mechanics = true;
    return scene;
  }();
  return out;
}

const Outcome& beat() {
  static const Outcome out = simulate(beating());
  return out;
}

TEST(SegmentMechanics, SegmentsAddUpToTheEnergyOfTheBeat) {
  const BeatResult& result = beat().result;
  ASSERT_TRUE(result.completed) << result.stop_reason;
  const EnergyBalance& energy = result.energy.value();
  EXPECT_LT(energy.percent(), 2);
  SegmentMechanics sum{};
  for (const SegmentMechanics& m : result.instants.back().mechanics) {
    sum.work_mJ += m.work_mJ;
    sum.active_work_mJ += m.active_work_mJ;
  }
  EXPECT_GT(energy.active_mJ, 500);
  EXPECT_NEAR(sum.active_work_mJ, energy.active_mJ, 1e-9 * energy.active_mJ);
  // The elastic part by trapezoids of the stress, there by the energies: 0.1 % apart.
  EXPECT_NEAR(sum.work_mJ, energy.active_mJ - energy.elastic_mJ - energy.viscosity_mJ,
              0.002 * energy.active_mJ);
  EXPECT_EQ(result.instants.front().mechanics.front().work_mJ, 0);
}

// Against means over the strain points, which end at the segments' borders: at most 0.0036 of −0.2 apart.
TEST(SegmentMechanics, FibreStrainIsThatOfTheStrainPoints) {
  const Outcome& outcome = beat();
  const Anatomy& heart = *beating().heart;
  const Discretisation& d = outcome.model.discretisation;
  const polyaffine::WallPoints points = strain_points(heart, d);
  const SegmentGauge gauge(*heart.coordinates, points);
  const polyaffine::FieldTable table = polyaffine::deformation_table(*d.basis, points);
  const FibreAxes axes = fibres_at(heart, *beating().fibres, points.tet, points.barycentric);
  const KeyStates key = key_states(outcome.path, beating());
  const std::size_t late = 40;
  const polyaffine::Matrix F = polyaffine::evaluate_field(table, outcome.path.outputs.at(late).c);
  const polyaffine::Matrix F_ed = polyaffine::evaluate_field(table, key.ed.c);
  Vector sum = Vector::Zero(17), volume = sum;
  for (Eigen::Index q = 0; q < F.cols(); ++q) {
    const int s = gauge.segment()[static_cast<std::size_t>(q)] - 1;
    const polyaffine::Vec3 f = axes.col(q).head<3>();
    const double stretch =
        (Mat3(F.col(q).reshaped(3, 3)) * f).norm() / (Mat3(F_ed.col(q).reshaped(3, 3)) * f).norm();
    sum[s] += points.weights[q] * (stretch - 1);
    volume[s] += points.weights[q];
  }
  const auto& told = outcome.result.instants.at(late).mechanics;
  for (int s = 0; s < 16; ++s) {
    EXPECT_LT(sum[s] / volume[s], -0.05);
    EXPECT_NEAR(told[static_cast<std::size_t>(s)].fibre_strain, sum[s] / volume[s], 0.007) << s + 1;
  }
}

// What the points stand for: their weights, and the volumes of the segments to 1e-5.
TEST(SegmentShares, KeepTheVolumesOfPointsAndSegments) {
  const Discretisation& d = beat().model.discretisation;
  const Anatomy& heart = *beating().heart;
  const polyaffine::Matrix shares = segment_shares(heart, d);
  EXPECT_LT((shares.colwise().sum().transpose() - d.points.weights).cwiseAbs().maxCoeff(),
            1e-12 * d.points.weights.sum());
  const SegmentGauge fine(*heart.coordinates, strain_points(heart, d));
  Vector volumes = Vector::Zero(17);
  for (std::size_t k = 0; k < fine.segment().size(); ++k)
    volumes[fine.segment()[k] - 1] += fine.weights()[static_cast<Eigen::Index>(k)];
  for (int s = 0; s < 17; ++s) EXPECT_NEAR(shares.row(s).sum(), volumes[s], 2e-5 * volumes[s]) << s + 1;
}

}  // namespace
}  // namespace cardiac
