#include "cardiac/anatomy/coordinates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <polyaffine/core/error.hpp>

#include "support/land_ellipsoid.hpp"

namespace cardiac {
namespace {

using polyaffine::InputError;
using polyaffine::kPi;
using polyaffine::Mat3;
using polyaffine::Vec3;
using polyaffine::Vec4;
using testing::LandEllipsoid;

// Calls check(tet, barycentric, X, sample) for two points of every tet.
template <class Check>
void for_points(const Check& check) {
  const auto& land = LandEllipsoid::get();
  for (int t = 0; t < land.mesh.num_tets(); ++t)
    for (const Vec4& l : {Vec4(0.25, 0.25, 0.25, 0.25), Vec4(0.55, 0.2, 0.1, 0.15)})
      check(t, l, land.coordinates->position(t, l), land.coordinates->sample(t, l));
}

double off_axis(const Vec3& X) {
  return X.head<2>().norm();
}

TEST(Coordinates, AxisCentreAndLengthAreThoseOfTheEllipsoid) {
  const auto& c = *LandEllipsoid::get().coordinates;
  EXPECT_LT((c.axis() - Vec3::UnitZ()).norm(), 1e-6);  // the mean normal of a flat base
  EXPECT_LT((c.anterior() - Vec3::UnitY()).norm(), 1e-6);
  EXPECT_NEAR(c.base_centre().z(), 5, 1e-9);
  EXPECT_LT(off_axis(c.base_centre()), 0.02);  // chords of a rim of uneven edges
  EXPECT_NEAR(c.cavity_length(), 22, 0.1);
  EXPECT_NEAR(c.long_axis_height(Vec3(3, 2, 5)), 1, 1e-6);
  EXPECT_NEAR(c.long_axis_height(Vec3(0, 0, -17)), 0, 5e-3);
  // Mid-wall meridian of semi-axes 8.5 and 18.5, from the apex to z = 5 (from 17 to 20 in the wall): 28.2 mm.
  double meridian = 0;
  constexpr int kParts = 2000;
  const double end = std::asin(5 / 18.5);
  for (int k = 0; k < kParts; ++k) {
    const double a = -kPi / 2 + (k + 0.5) / kParts * (end + kPi / 2);
    meridian += std::hypot(8.5 * std::sin(a), 18.5 * std::cos(a)) * (end + kPi / 2) / kParts;
  }
  EXPECT_NEAR(c.arc_length(), meridian, 0.08 * meridian);
}

TEST(Coordinates, DepthIsThatOfTheEllipsoids) {
  for_points([](int, const Vec4&, const Vec3& X, const CoordinateSample& s) {
    EXPECT_GE(s.t, -0.02);
    EXPECT_LE(s.t, 1.02);
    // A harmonic depth would run ahead of the geometric one where the wall spreads outwards: in mid-wall by
    // .04 in a cylinder of radii 7 and 10, by .13 in a sphere with the apex's radii of curvature, 2.9 and 5.
    EXPECT_NEAR(s.t, testing::analytic_depth(X), X.z() > -12 ? 0.03 : 0.06) << X.transpose();
  });
  const auto& land = LandEllipsoid::get();
  for (const int n : land.coordinates->space().surface_nodes(land.mesh, {1}))
    EXPECT_EQ(land.coordinates->transmural()[n], 0);
}

TEST(Coordinates, ApicobasalGrowsFromTheApexToTheBase) {
  const auto& land = LandEllipsoid::get();
  const auto& c = *land.coordinates;
  const polyaffine::Vector u = c.apicobasal();
  for (const int n : c.space().surface_nodes(land.mesh, {3})) EXPECT_EQ(u[n], 1);
  EXPECT_GE(u.minCoeff(), 0);
  EXPECT_LT(u.minCoeff(), 0.05);
  std::vector<std::pair<double, double>> samples;  // height, u
  for_points([&](int, const Vec4&, const Vec3& X, const CoordinateSample& s) {
    samples.emplace_back(c.long_axis_height(X), s.u);
    if (off_axis(X) > 2) {
      EXPECT_GT(s.grad_u.dot(testing::analytic_axes(X).col(0)), 0) << X.transpose();
    }
  });
  // Higher up by a seventh of the cavity means a larger coordinate, wherever in the wall.
  for (const auto& [h1, u1] : samples)
    for (const auto& [h2, u2] : samples)
      if (h2 > h1 + 1.0 / 7) {
        ASSERT_GT(u2, u1) << h1 << ' ' << h2;
      }
}

TEST(Coordinates, ApicobasalIsProportionalToArcLength) {
  const double length = LandEllipsoid::get().coordinates->arc_length();
  double sum = 0;
  int count = 0;
  for_points([&](int, const Vec4&, const Vec3& X, const CoordinateSample& s) {
    if (X.z() < -10 || X.z() > 3) return;
    sum += length * s.grad_u.norm();
    ++count;
  });
  EXPECT_NEAR(sum / count, 1, 0.03);  // mean over the body of the ventricle
}

TEST(Coordinates, RotationIsCounterClockwiseSeenFromTheApex) {
  const auto& c = *LandEllipsoid::get().coordinates;
  const Vec3 centre(c.base_centre().x(), c.base_centre().y(), -3);
  EXPECT_NEAR(c.angle(centre + Vec3(0, 9, 0)), 0, 1e-6);               // anterior
  EXPECT_NEAR(c.angle(centre + Vec3(9, 0, 0)), kPi / 2, 1e-6);         // septum
  EXPECT_NEAR(c.angle(centre + Vec3(-9, 0, 0)), -kPi / 2, 1e-6);       // lateral wall
  EXPECT_NEAR(std::abs(c.angle(centre + Vec3(0, -9, 0))), kPi, 1e-6);  // inferior
  // Looking up the long axis from below, +y up, +x is to the left: from +y to +x counter-clockwise.
  const Vec3 to_the_right = Vec3::UnitZ().cross(Vec3::UnitY());
  EXPECT_LT(to_the_right.x(), 0);
  for_points([&](int, const Vec4&, const Vec3& X, const CoordinateSample& s) {
    EXPECT_NEAR(std::remainder(s.psi - c.angle(X), 2 * kPi), 0, 1e-12);
  });
}

TEST(Coordinates, AnotherAnteriorDirectionTurnsTheRotation) {
  const auto& land = LandEllipsoid::get();
  AnatomyOptions options;
  options.anterior = Vec3(2, 0, 5);  // only its part across the axis counts
  options.long_axis = Vec3(0, 0, 3);
  const VentricularCoordinates c(land.mesh, SurfaceLabels{}, options);
  const Vec3 centre(c.base_centre().x(), c.base_centre().y(), 0);
  EXPECT_NEAR(c.angle(centre + Vec3(5, 0, 0)), 0, 1e-12);
  EXPECT_NEAR(c.angle(centre + Vec3(0, -5, 0)), kPi / 2, 1e-12);
}

TEST(Coordinates, AxesAreOrthonormalAndFollowTheEllipsoid) {
  double worst = 0;
  double angle = 0;
  for_points([&](int, const Vec4&, const Vec3& X, const CoordinateSample& s) {
    if (off_axis(X) < 4) return;  // e_c turns round within one element about the axis
    worst = std::max(worst, (s.Q.transpose() * s.Q - Mat3::Identity()).cwiseAbs().maxCoeff());
    EXPECT_LT(s.Q.determinant(), -0.9);  // longitudinal, circumferential, radial is left-handed
    for (int k = 0; k < 3; ++k)
      angle = std::max(
          angle, std::acos(std::min(1.0, s.Q.col(k).normalized().dot(testing::analytic_axes(X).col(k)))));
  });
  EXPECT_LT(worst, 1e-12);
  EXPECT_LT(angle, 8 * kPi / 180);
  const auto& nodal = LandEllipsoid::get().coordinates->axes();
  for (Eigen::Index n = 0; n < nodal.cols(); ++n) {
    const Mat3 Q = nodal.col(n).reshaped(3, 3);
    EXPECT_LT((Q.transpose() * Q - Mat3::Identity()).norm(), 1e-12);
  }
}

TEST(Coordinates, GradientsMatchFiniteDifferences) {
  const auto& land = LandEllipsoid::get();
  constexpr double kStep = 1e-4;
  double largest = 0;
  for (int t = 0; t < land.mesh.num_tets(); t += 7) {
    const Vec4 l(0.4, 0.3, 0.2, 0.1);
    const CoordinateSample s = land.coordinates->sample(t, l);
    if (off_axis(land.coordinates->position(t, l)) < 2) continue;
    for (int k = 1; k < 4; ++k) {
      const Vec4 d = kStep * (Vec4::Unit(k) - Vec4::Unit(0));
      const CoordinateSample ahead = land.coordinates->sample(t, l + d);
      const CoordinateSample back = land.coordinates->sample(t, l - d);
      const Vec3 dX = land.coordinates->position(t, l + d) - land.coordinates->position(t, l - d);
      EXPECT_NEAR(ahead.u - back.u, s.grad_u.dot(dX), 1e-10);  // third order in the step
      // Quadratic in the barycentric coordinates: central differences are exact but for rounding, 1e-16.
      EXPECT_NEAR(ahead.t - back.t, s.grad_t.dot(dX), 1e-13);
      EXPECT_NEAR(std::remainder(ahead.psi - back.psi, 2 * kPi), s.grad_psi.dot(dX),
                  1e-10);  // third order in the step
      Mat3 dQ = Mat3::Zero();
      for (int J = 0; J < 3; ++J) dQ += dX[J] * s.dQ[J];
      EXPECT_LT((ahead.Q - back.Q - dQ).norm(), 1e-9);
      largest = std::max(largest, dQ.norm() / dX.norm());
    }
  }
  EXPECT_GT(largest, 0.1);  // 1/mm: the axes do turn, by about 1/radius
}

TEST(Coordinates, PlaceIsThatOfTheSample) {
  for_points([](int t, const Vec4& l, const Vec3&, const CoordinateSample& s) {
    const CoordinatePlace place = LandEllipsoid::get().coordinates->place(t, l);
    EXPECT_EQ(place.u, s.u);
    EXPECT_EQ(place.t, s.t);
    EXPECT_EQ(place.psi, s.psi);
  });
}

TEST(Coordinates, WhatIsMissingIsNamed) {
  const auto& mesh = LandEllipsoid::get().mesh;
  const auto make = [&](SurfaceLabels labels, const AnatomyOptions& options = {}) {
    return VentricularCoordinates(mesh, labels, options);
  };
  const auto message = [&](SurfaceLabels labels) -> std::string {
    try {
      make(labels);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_NE(message({9, 2, 3}).find("endo"), std::string::npos);
  EXPECT_NE(message({1, 9, 3}).find("epi"), std::string::npos);
  EXPECT_NE(message({1, 2, 9}).find("base"), std::string::npos);
  EXPECT_NE(message({1, 3, 2}).find("rim"), std::string::npos);  // endocardium and "base" do not meet
  AnatomyOptions parallel;
  parallel.anterior = Vec3(0, 0, -1);
  EXPECT_THROW(make({}, parallel), InputError);
}

}  // namespace
}  // namespace cardiac
