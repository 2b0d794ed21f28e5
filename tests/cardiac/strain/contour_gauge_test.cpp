#include "cardiac/strain/contour_gauge.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>

#include <cardiac/anatomy/segments.hpp>

#include "support/biventricle.hpp"
#include "support/land_ellipsoid.hpp"

namespace cardiac {
namespace {

using polyaffine::kPi;
using polyaffine::Points;
using polyaffine::Vec3;
using testing::LandEllipsoid;

/// The motion of the Land ellipsoid (axis z, apex −z, semi-axes 7 + 3t and 17 + 3t mm, base at 5 mm).
using Motion = std::function<Vec3(const Vec3&)>;

Points moved(const Points& X, const Motion& motion) {
  Points out = X;
  for (auto x : out.colwise()) x = motion(x);
  return out;
}

GlobalStrain measured(
    const Motion& motion, const Motion& ed = [](const Vec3& X) { return X; }) {
  const auto& [mesh, coordinates] = LandEllipsoid::get();
  static const auto segment = segment_tets(mesh, *coordinates);
  GlobalStrain out;
  ContourGauge(mesh, *coordinates, segment, {}, ContourGauge::Side::left, moved(mesh.points(), ed))
      .measure(moved(mesh.points(), motion), out);
  return out;
}

void expect_layers(const LayerStrain& found, double endo, double mid, double epi, double tolerance) {
  EXPECT_NEAR(found.endocardial_percent, endo, tolerance);
  EXPECT_NEAR(found.midwall_percent, mid, tolerance);
  EXPECT_NEAR(found.epicardial_percent, epi, tolerance);
}

// Exact on any mesh: lines are straight between points that move by an affine map.
TEST(ContourGauge, AUniformStretchIsTheSameInAllLayers) {
  const auto g = measured([](const Vec3& X) { return Vec3(1.1 * X); });
  expect_layers(g.longitudinal, 10, 10, 10, 1e-9);
  expect_layers(g.circumferential, 10, 10, 10, 1e-9);
  EXPECT_NEAR(g.wall_thickening_percent, 10, 1e-9);
}

TEST(ContourGauge, ATurnIsNoStrain) {
  const Eigen::AngleAxisd turn(0.7, Vec3(1, -2, 3).normalized());
  const auto g = measured([&](const Vec3& X) { return Vec3(turn * X + Vec3(3, 2, 1)); });
  expect_layers(g.longitudinal, 0, 0, 0, 1e-9);
  expect_layers(g.circumferential, 0, 0, 0, 1e-9);
  EXPECT_NEAR(g.wall_thickening_percent, 0, 1e-9);
}

// Arc of the meridian of an ellipsoid from apex to base by Simpson's rule.
double arc(double s, double l, double base) {
  const double end = std::acos(-base / l);
  const auto speed = [&](double a) { return std::hypot(s * std::cos(a), l * std::sin(a)); };
  constexpr int n = 2000;
  double sum = speed(0) + speed(end);
  for (int i = 1; i < n; ++i) sum += (i % 2 == 1 ? 4 : 2) * speed(end * i / n);
  return sum * end / n / 3;
}

TEST(ContourGauge, LongitudinalIsTheArcFromBaseRoundTheApexToBase) {
  const auto g = measured([](const Vec3& X) { return Vec3(X.x(), X.y(), 0.8 * X.z()); });
  const auto expected = [](double t) {
    return 100 * (arc(7 + 3 * t, 0.8 * (17 + 3 * t), 4) / arc(7 + 3 * t, 17 + 3 * t, 5) - 1);
  };
  // Chords of a coarse mesh; the mid-wall passes through elements a third of the wall thick.
  expect_layers(g.longitudinal, expected(0), expected(0.5), expected(1), 0.3);
  expect_layers(g.circumferential, 0, 0, 0, 1e-9);
  EXPECT_LT(expected(1), -14);
  // The rim lies at z = 5, the epicardial apex at −20 mm, where the mesh has a vertex within half a
  // millimetre.
  EXPECT_NEAR(g.base_excursion_mm, 0.2 * 25, 0.05);
  EXPECT_NEAR(g.apex_motion_mm, 0.2 * 20, 0.05);
}

// The wall moves inwards by 1.4 (1 − t) mm: at the middles of the thirds of the cavity's 22 mm, rings of
// radius r shorten by 1.4 (1 − t)/r.
TEST(ContourGauge, CircumferentialTellsTheLayersApart) {
  const auto inwards = [](double t) { return 1.4 * (1 - t); };
  const auto g = measured([&](const Vec3& X) {
    const double s = 1 - inwards(testing::analytic_depth(X)) / std::hypot(X.x(), X.y());
    return Vec3(s * X.x(), s * X.y(), X.z());
  });
  const auto expected = [&](double t) {
    double sum = 0;
    for (const double height : {1.0 / 6, 1.0 / 2, 5.0 / 6}) {
      const double z = (-17 + 22 * height) / (17 + 3 * t);
      sum -= 100 * inwards(t) / ((7 + 3 * t) * std::sqrt(1 - z * z)) / 3;
    }
    return sum;
  };
  EXPECT_LT(expected(0), -20);
  // Rings of chords; of the coarse mesh one element or two through the wall.
  expect_layers(g.circumferential, expected(0), expected(0.5), expected(1), 1);
}

TEST(ContourGauge, ThickeningIsThatOfTheDistanceBetweenTheSurfaces) {
  // Points go outwards along the normal by .2 × the distance from the endocardium, which thickens by a fifth.
  const auto g = measured([](const Vec3& X) {
    const double t = testing::analytic_depth(X);
    return Vec3(X + 0.2 * 3 * t * testing::analytic_axes(X).col(2));
  });
  EXPECT_NEAR(g.wall_thickening_percent, 20, 1);
  EXPECT_NEAR(g.longitudinal.endocardial_percent, 0, 0.1);
}

TEST(ContourGauge, IsAgainstEndDiastole) {
  const auto doubled = [](const Vec3& X) { return Vec3(2 * X); };
  const auto g = measured([](const Vec3& X) { return Vec3(1.8 * X); }, doubled);
  expect_layers(g.longitudinal, -10, -10, -10, 1e-9);
  expect_layers(g.circumferential, -10, -10, -10, 1e-9);
  EXPECT_NEAR(g.base_excursion_mm, 0.2 * 25, 0.05);
}

class RightContours : public ::testing::Test {
 protected:
  static GlobalStrain measured(ContourGauge::Side side, const Motion& motion) {
    const auto& both = testing::Biventricle::get();
    static const auto segment = segment_tets(both.mesh, *both.coordinates);
    SurfaceLabels labels;
    labels = testing::kBothLabels;
    GlobalStrain out;
    ContourGauge(both.mesh, *both.coordinates, segment, labels, side, both.mesh.points())
        .measure(moved(both.mesh.points(), motion), out);
    return out;
  }
};

TEST_F(RightContours, ThatOfTheFreeWallIsLongitudinalOnly) {
  const auto g = measured(ContourGauge::Side::right, [](const Vec3& X) { return Vec3(0.9 * X); });
  expect_layers(g.longitudinal, -10, -10, -10, 1e-9);
  EXPECT_NEAR(g.wall_thickening_percent, -10, 1e-9);
  EXPECT_TRUE(std::isnan(g.circumferential.endocardial_percent));
  EXPECT_TRUE(std::isnan(g.circumferential.epicardial_percent));
  EXPECT_GT(g.base_excursion_mm, 3);
}

TEST_F(RightContours, LinesRunFromBaseToApex) {
  const Vec3 axis = testing::Biventricle::get().coordinates->axis();
  const auto along = [&](const Vec3& X) { return Vec3(X - 0.2 * X.dot(axis) * axis); };
  const auto across = [&](const Vec3& X) { return Vec3(0.8 * X + 0.2 * X.dot(axis) * axis); };
  const auto of_along = measured(ContourGauge::Side::right, along).longitudinal;
  const auto of_across = measured(ContourGauge::Side::right, across).longitudinal;
  for (const auto layer :
       {&LayerStrain::endocardial_percent, &LayerStrain::midwall_percent, &LayerStrain::epicardial_percent}) {
    EXPECT_LT(of_along.*layer, -12);  // −20 where a line runs along the axis, 0 across it
    EXPECT_GT(of_across.*layer, -8);
  }
}

TEST_F(RightContours, TheLeftOnesOfTwoVentriclesHaveAllLayers) {
  const auto g = measured(ContourGauge::Side::left, [](const Vec3& X) { return Vec3(0.9 * X); });
  expect_layers(g.longitudinal, -10, -10, -10, 1e-9);
  expect_layers(g.circumferential, -10, -10, -10, 1e-9);
}

}  // namespace
}  // namespace cardiac
