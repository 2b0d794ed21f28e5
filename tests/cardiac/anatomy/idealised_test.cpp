#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cardiac/anatomy/idealised.hpp>
#include <cmath>
#include <limits>
#include <polyaffine/core/error.hpp>
#include <random>

namespace cardiac {
namespace {

using polyaffine::InputError;
using polyaffine::kPi;

const std::vector<TruncatedEllipsoid> kShapes{land_ellipsoid(), human_lv()};

/// ∫ π r(z)² dz from the apex to the base by Simpson's rule, exact for this quadratic integrand.
double cap_by_simpson(double a, double c, double top) {
  const auto area = [&](double z) { return kPi * a * a * (1 - z * z / (c * c)); };
  return (top + c) / 6 * (area(-c) + 4 * area((top - c) / 2) + area(top));
}

TEST(Idealised, VolumesEqualTheIntegralOfSections) {
  for (const auto& s : kShapes) {
    const double cavity = cap_by_simpson(s.endo_short_mm, s.endo_long_mm, s.base_z_mm);
    const double outer = cap_by_simpson(s.epi_short_mm, s.epi_long_mm, s.base_z_mm);
    EXPECT_NEAR(exact_cavity_volume(s), cavity, 1e-12 * cavity);
    EXPECT_NEAR(exact_wall_volume(s), outer - cavity, 1e-12 * outer);
  }
}

TEST(Idealised, HumanVentricleHasAPlausibleUnloadedCavity) {
  EXPECT_NEAR(exact_cavity_volume(human_lv()) / 1000, 75, 3);  // mL
  EXPECT_NEAR(human_lv().endo_long_mm + human_lv().base_z_mm, 80, 5);
}

TEST(Idealised, ScaledShapesKeepTheirWallsAndBases) {
  const auto numbers = [](const TruncatedEllipsoid& s) {
    return std::array{s.endo_short_mm, s.endo_long_mm, s.epi_short_mm, s.epi_long_mm, s.base_z_mm};
  };
  for (const auto& s : kShapes) {
    EXPECT_EQ(numbers(scaled(s, 1, 1)), numbers(s)) << "bit for bit";
    const TruncatedEllipsoid wide = scaled(s, 1.25, 1), thick = scaled(s, 1, 1.5);
    EXPECT_NEAR(exact_cavity_volume(wide), 1.25 * 1.25 * 1.25 * exact_cavity_volume(s),
                1e-12 * exact_cavity_volume(wide));
    EXPECT_NEAR(wide.epi_short_mm - wide.endo_short_mm, s.epi_short_mm - s.endo_short_mm, 1e-12);
    EXPECT_NEAR(wide.epi_long_mm - wide.endo_long_mm, s.epi_long_mm - s.endo_long_mm, 1e-12);
    EXPECT_EQ(exact_cavity_volume(thick), exact_cavity_volume(s));
    EXPECT_NEAR(thick.epi_short_mm - thick.endo_short_mm, 1.5 * (s.epi_short_mm - s.endo_short_mm), 1e-12);
  }
  EXPECT_THROW(scaled(human_lv(), 1, 0), InputError);
  EXPECT_THROW(scaled(human_lv(), -1, 1), InputError);
}

TEST(Idealised, WallFunctionHasTheSignOfTheSide) {
  for (const auto& s : kShapes) {
    const double middle = (s.endo_short_mm + s.epi_short_mm) / 2;
    EXPECT_LT(wall_function(s, {middle, 0, 0}), 0);
    EXPECT_LT(wall_function(s, {0, 0, -(s.endo_long_mm + s.epi_long_mm) / 2}), 0);
    EXPECT_GT(wall_function(s, {0, 0, 0}), 0) << "the cavity";
    EXPECT_GT(wall_function(s, {s.epi_short_mm + 1, 0, 0}), 0);
    EXPECT_GT(wall_function(s, {middle, 0, s.base_z_mm + 0.1}), 0);
    EXPECT_NEAR(wall_function(s, {s.endo_short_mm, 0, 0}), 0, 1e-12);
    EXPECT_NEAR(wall_function(s, {0, 0, -s.epi_long_mm}), 0, 1e-12);
    EXPECT_NEAR(wall_function(s, {s.epi_short_mm + 0.01, 0, 0}), 0.01, 1e-5) << "mm near the surface";
  }
}

TEST(Idealised, RimsLieOnBothSurfacesAndClose) {
  for (const auto& s : kShapes) {
    const auto [endo, epi] = rims(s, 24);
    for (const auto* rim : {&endo, &epi}) {
      EXPECT_EQ(rim->cols(), 25);
      EXPECT_EQ(rim->col(0), rim->col(24));
      for (const auto& x : rim->colwise()) EXPECT_EQ(x.z(), s.base_z_mm);
    }
    EXPECT_LT((project_to_surface(s, kEndocardium, endo.col(3)) - endo.col(3)).norm(), 1e-11);
    EXPECT_LT((project_to_surface(s, kEpicardium, epi.col(3)) - epi.col(3)).norm(), 1e-11);
  }
}

class Projection : public ::testing::TestWithParam<std::array<double, 2>> {};

TEST_P(Projection, IsTheNearestPoint) {
  const auto [a, c] = GetParam();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-1.5 * c, 1.5 * c);
  for (int i = 0; i < 200; ++i) {
    const Vec3 x(coordinate(random), coordinate(random), coordinate(random));
    const Vec3 p = project_to_ellipsoid(a, c, x);
    const double level = p.head<2>().squaredNorm() / (a * a) + p.z() * p.z() / (c * c);
    EXPECT_NEAR(level, 1, 1e-9);
    // Among 720 points of the meridian through x none is nearer (sampling can only be farther).
    const double r = std::hypot(x.x(), x.y());
    for (int k = 0; k < 720; ++k) {
      const double angle = 2 * kPi * k / 720;
      EXPECT_LE((p - x).norm(), std::hypot(a * std::cos(angle) - r, c * std::sin(angle) - x.z()) + 1e-9);
    }
  }
}

TEST_P(Projection, LeavesSurfacePointsAndFindsPointsMovedAlongTheNormal) {
  const auto [a, c] = GetParam();
  for (const double polar : {0.1, 0.7, 1.5, 2.4, 3.0}) {
    const Vec3 on(a * std::sin(polar) * std::cos(0.4), a * std::sin(polar) * std::sin(0.4),
                  c * std::cos(polar));
    const Vec3 normal = Vec3(on.x() / (a * a), on.y() / (a * a), on.z() / (c * c)).normalized();
    EXPECT_LT((project_to_ellipsoid(a, c, on) - on).norm(), 1e-10);
    EXPECT_LT((project_to_ellipsoid(a, c, on + 2 * normal) - on).norm(), 1e-10);
    EXPECT_LT((project_to_ellipsoid(a, c, on - 0.2 * normal) - on).norm(), 1e-10);
  }
}

TEST_P(Projection, PointsOnTheAxesAndTheCentre) {
  const auto [a, c] = GetParam();
  EXPECT_LT((project_to_ellipsoid(a, c, {0, 0, -2 * c}) - Vec3(0, 0, -c)).norm(), 1e-9);
  EXPECT_LT((project_to_ellipsoid(a, c, {0, 3 * a, 0}) - Vec3(0, a, 0)).norm(), 1e-9);
  const Vec3 centre = project_to_ellipsoid(a, c, Vec3::Zero());
  EXPECT_NEAR(centre.norm(), std::min(a, c), 1e-6);
  // A point of the focal set off the centre: its nearest points by sampling the meridian.
  const Vec3 off = a < c ? Vec3(0, 0, 0.3 * (c - a)) : Vec3(0.3 * (a - c), 0, 0);
  double nearest = a + c;
  for (int k = 0; k < 7200; ++k) {
    const double angle = 2 * kPi * k / 7200;
    nearest = std::min(nearest, (Vec3(a * std::cos(angle), 0, c * std::sin(angle)) - off).norm());
  }
  EXPECT_NEAR((project_to_ellipsoid(a, c, off) - off).norm(), nearest, 1e-5);  // angle steps of 1e-3, squared
}

INSTANTIATE_TEST_SUITE_P(LongFlatRound, Projection,
                         ::testing::Values(std::array{7.0, 17.0}, std::array{17.0, 7.0},
                                           std::array{10.0, 10.0}));

TEST(Idealised, ProjectionToTheWallPutsRimPointsOnTheRim) {
  for (const auto& s : kShapes) {
    const Vec3 rim = rims(s, 8)[0].col(1);
    const Vec3 back = project_to_wall_surface(s, 0.05, rim + Vec3(0.01, -0.01, 0.01));
    EXPECT_EQ(back.z(), s.base_z_mm);
    EXPECT_NEAR(back.head<2>().norm(), rim.head<2>().norm(), 1e-12);
    const Vec3 epi(0, 0, -s.epi_long_mm + 0.01);
    EXPECT_LT((project_to_wall_surface(s, 0.05, epi) - Vec3(0, 0, -s.epi_long_mm)).norm(), 1e-9);
    const Vec3 base((s.endo_short_mm + s.epi_short_mm) / 2, 0, s.base_z_mm - 0.02);
    EXPECT_EQ(project_to_wall_surface(s, 0.05, base), Vec3(base.x(), 0, s.base_z_mm));
  }
}

TEST(Idealised, LabelsOfTriangles) {
  const auto s = land_ellipsoid();
  const auto [endo, epi] = rims(s, 8);
  EXPECT_EQ(surface_label(s, 1e-6, {endo.col(0), endo.col(1), epi.col(0)}), kBase);
  EXPECT_EQ(surface_label(s, 1e-6, {endo.col(0), endo.col(1), Vec3(7, 0, 0)}), kEndocardium);
  EXPECT_EQ(surface_label(s, 1e-6, {epi.col(0), epi.col(1), Vec3(10, 0, 0)}), kEpicardium);
  EXPECT_THROW(surface_label(s, 1e-6, {Vec3(7, 0, 0), Vec3(10, 0, 0), endo.col(0)}),
               polyaffine::ComputationError);
}

TEST(Idealised, WrongShapesAreNamed) {
  const auto error_of = [](auto change) {
    TruncatedEllipsoid s = human_lv();
    change(s);
    try {
      check_shape(s);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  using ::testing::HasSubstr;
  EXPECT_EQ(error_of([](auto&) {}), "no error");
  EXPECT_THAT(error_of([](auto& s) { s.endo_short_mm = 0; }), HasSubstr("endo_short_mm"));
  EXPECT_THAT(error_of([](auto& s) { s.epi_long_mm = std::numeric_limits<double>::quiet_NaN(); }),
              HasSubstr("epi_long_mm"));
  EXPECT_THAT(error_of([](auto& s) { s.epi_short_mm = s.endo_short_mm; }),
              HasSubstr("more than the endocardial"));
  EXPECT_THAT(error_of([](auto& s) { s.base_z_mm = s.endo_long_mm; }), HasSubstr("base_z_mm"));
}

}  // namespace
}  // namespace cardiac
