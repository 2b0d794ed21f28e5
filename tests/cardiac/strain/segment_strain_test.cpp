#include "cardiac/strain/segment_strain.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <functional>

#include <cardiac/anatomy/segments.hpp>

#include "support/land_ellipsoid.hpp"
#include "support/random_vector.hpp"

namespace cardiac {
namespace {

using polyaffine::kPi;
using polyaffine::Mat3;
using polyaffine::Matrix;
using polyaffine::Points;
using polyaffine::Vec3;
using testing::LandEllipsoid;

/// Segments of the Land ellipsoid; its long axis is z, the apex at −z.
const SegmentGauge& gauge() {
  static const SegmentGauge out(*LandEllipsoid::get().coordinates,
                                LandEllipsoid::get().coordinates->space().wall_points(2));
  return out;
}

Matrix everywhere(const Mat3& F) {
  return F.reshaped().replicate(1, gauge().weights().size());
}

std::vector<SegmentStrain> strain(const Mat3& F, const Mat3& F_ed = Mat3::Identity()) {
  return gauge().strain(everywhere(F), everywhere(F_ed));
}

Mat3 rotation(double angle, const Vec3& axis) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

void expect_near(const SegmentStrain& a, const SegmentStrain& b, double tolerance) {
  EXPECT_NEAR(a.longitudinal, b.longitudinal, tolerance);
  EXPECT_NEAR(a.circumferential, b.circumferential, tolerance);
  EXPECT_NEAR(a.radial, b.radial, tolerance);
  EXPECT_NEAR(a.shear_lc, b.shear_lc, tolerance);
  EXPECT_NEAR(a.shear_lr, b.shear_lr, tolerance);
  EXPECT_NEAR(a.shear_cr, b.shear_cr, tolerance);
  EXPECT_NEAR(a.volume_ratio, b.volume_ratio, tolerance);
}

TEST(SegmentStrain, OfAUniformStretchIsTheSameInAllDirections) {
  for (const auto& s : strain(1.3 * Mat3::Identity()))
    expect_near(s, {0.3, 0.3, 0.3, 0, 0, 0, std::pow(1.3, 3)}, 1e-12);
}

// E = ½ (FᵀF − I) does not see a turn. A stretch along z is longitudinal at the base, radial at the apex.
TEST(SegmentStrain, GreenLagrangeIsTheTensorInLocalAxes) {
  for (const Mat3& E : gauge().green_lagrange(everywhere(rotation(0.7, {1, 2, -3}) * 1.2)))
    EXPECT_LT((E - 0.22 * Mat3::Identity()).cwiseAbs().maxCoeff(), 1e-12);
  const Mat3 stretch = Vec3(1, 1, 1.1).asDiagonal();
  const auto E = gauge().green_lagrange(everywhere(rotation(0.4, {1, 0, 1}) * stretch));
  for (int s = 0; s < 17; ++s) EXPECT_NEAR(E[s].trace(), 0.105, 1e-12);
  for (int s = 0; s < 6; ++s) {
    EXPECT_GT(E[s](0, 0), 0.09);
    EXPECT_NEAR(E[s](1, 1), 0, 1e-4);
  }
  EXPECT_GT(E[16](2, 2), 0.07);
}

TEST(SegmentStrain, OfARotationIsZero) {
  for (const auto& s : strain(rotation(0.7, {1, 2, -3}))) expect_near(s, {0, 0, 0, 0, 0, 0, 1}, 1e-12);
}

// Circumferential axes are across the long axis in every mesh; near it, interpolation tilts them a little.
constexpr double kAcross = 1e-4;

TEST(SegmentStrain, AlongTheAxisIsThatOfTheEllipsoidsDirections) {
  constexpr double kStretch = 0.8;
  const Mat3 F = Vec3(1, 1, kStretch).asDiagonal();
  const auto found = strain(F);
  // Means over the segments with the directions of the ellipsoid through each point.
  std::vector<SegmentStrain> expected(kAhaSegments, SegmentStrain{0, 0, 0, 0, 0, 0, kStretch});
  std::vector<double> volume(kAhaSegments, 0.0);
  for (Eigen::Index q = 0; q < gauge().weights().size(); ++q) {
    const Mat3 C = (F * testing::analytic_axes(gauge().positions().col(q))).eval().transpose() * F *
                   testing::analytic_axes(gauge().positions().col(q));
    const int k = gauge().segment()[q] - 1;
    const double w = gauge().weights()[q];
    volume[k] += w;
    expected[k].longitudinal += w * (std::sqrt(C(0, 0)) - 1);
    expected[k].radial += w * (std::sqrt(C(2, 2)) - 1);
    expected[k].shear_lr += w * 0.5 * C(0, 2);
  }
  for (int s = 1; s <= 16; ++s) {  // in the cap directions are a matter of definition
    SCOPED_TRACE(aha_name(s));
    SegmentStrain& e = expected[s - 1];
    for (double* value : {&e.longitudinal, &e.radial, &e.shear_lr}) *value /= volume[s - 1];
    expect_near(found[s - 1], e, 0.01);  // axes of the mesh, a few degrees off the ellipsoid's
    EXPECT_NEAR(found[s - 1].circumferential, 0, kAcross);
    EXPECT_LT(found[s - 1].longitudinal, aha_ring(s) == 1 ? -0.1 : -0.17);
  }
}

TEST(SegmentStrain, AcrossTheAxisIsCircumferentialInEverySegment) {
  for (const auto& s : strain(Vec3(1.2, 1.2, 1).asDiagonal())) {
    EXPECT_NEAR(s.circumferential, 0.2, kAcross);
    EXPECT_NEAR(s.volume_ratio, 1.44, 1e-12);
  }
}

TEST(SegmentStrain, IsAgainstEndDiastoleInAxesThatTurnWithIt) {
  const Mat3 stretch =
      Mat3::Identity() + 0.1 * Mat3(polyaffine::testing::random_vector(9, 1, 3).reshaped(3, 3));
  const Mat3 turn = rotation(1.1, {1, -1, 2});
  for (const auto& s : strain(stretch, stretch)) expect_near(s, {0, 0, 0, 0, 0, 0, 1}, 1e-12);
  const auto plain = strain(stretch);
  const auto turned = strain(turn * stretch, turn);  // the whole heart turned, in both states alike
  const auto carried = strain(turn * stretch * turn.transpose() * turn, turn);
  for (int k = 0; k < kAhaSegments; ++k) {
    SCOPED_TRACE(aha_name(k + 1));
    expect_near(turned[k], carried[k], 1e-12);
    expect_near(turned[k], plain[k], 1e-12);
    EXPECT_GT(std::abs(plain[k].longitudinal) + std::abs(plain[k].radial), 1e-3);
  }
}

// Seen from the apex, below −z, counter-clockwise is a positive turn about −z.
Points turned(const Points& X, const std::function<double(const Vec3&)>& degrees) {
  Points out = X;
  for (Eigen::Index q = 0; q < X.cols(); ++q)
    out.col(q) = rotation(degrees(X.col(q)) * kPi / 180, -Vec3::UnitZ()) * X.col(q);
  return out;
}

TEST(SegmentRotation, IsTheAngleCounterClockwiseSeenFromTheApex) {
  // The axis of the mesh passes the origin within 0.02 mm (chords of its rim): to a degree near the cap.
  for (const double angle : {10.0, -25.0}) {
    const auto found = gauge().rotation_deg(turned(gauge().positions(), [&](const Vec3&) { return angle; }),
                                            gauge().positions());
    ASSERT_EQ(found.size(), kAhaSegments);
    for (int s = 1; s <= kAhaSegments; ++s) EXPECT_NEAR(found[s - 1], angle, s == 17 ? 1.0 : 0.1) << s;
  }
}

TEST(GlobalStrain, TwistIsTheApexAgainstTheBase) {
  const std::vector<double> volume(kAhaSegments, 2.0);
  // From 12° at the apex (z = −17 mm) to −3° at the base (z = 5 mm), linear along the axis.
  const auto angle = [](const Vec3& X) { return -3 + 15 * (5 - X.z()) / 22; };
  const auto rotation = gauge().rotation_deg(turned(gauge().positions(), angle), gauge().positions());
  const GlobalStrain g = global_strain(std::vector<SegmentStrain>(kAhaSegments), rotation, volume);
  // Thirds of the axis: centres of the apical and the basal ring are about two thirds of it apart.
  EXPECT_NEAR(g.twist_deg, 15 * 2.0 / 3, 1);
  EXPECT_EQ(g.gls_percent, 0);
}

TEST(GlobalStrain, IsTheMeanByVolume) {
  std::vector<SegmentStrain> strain(kAhaSegments);
  std::vector<double> volume(kAhaSegments, 1.0);
  strain[3] = {-0.2, -0.1, 0.4, 0, 0, 0, 1};
  volume[3] = 4;  // of 20 in all
  const GlobalStrain g = global_strain(strain, std::vector<double>(kAhaSegments, 5.0), volume);
  EXPECT_NEAR(g.gls_percent, -4, 1e-12);
  EXPECT_NEAR(g.gcs_percent, -2, 1e-12);
  EXPECT_NEAR(g.grs_percent, 8, 1e-12);
  EXPECT_NEAR(g.twist_deg, 0, 1e-12);  // a rigid turn
}

}  // namespace
}  // namespace cardiac
