#include "cardiac/fibres/helix.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/land_ellipsoid.hpp"

namespace cardiac {
namespace {

using polyaffine::kPi;
using polyaffine::Mat3;
using polyaffine::Vec3;
using polyaffine::Vec4;
using testing::LandEllipsoid;

constexpr double kDegree = kPi / 180;

// Angle of the fibre from circumferential towards the base, in the axes of the exact ellipsoid, and its dip
// out of the tangent plane; degrees.
std::pair<double, double> exact_angles(const Vec3& f, const Vec3& X) {
  const Vec3 local = testing::analytic_axes(X).transpose() * f;
  return {std::atan2(local[0], local[1]) / kDegree, std::asin(local[2]) / kDegree};
}

bool in_the_body(const Vec3& X) {
  return X.z() > -12;
}

TEST(Helix, AnglesOnTheSurfacesAreThoseAskedFor) {
  const auto& land = LandEllipsoid::get();
  for (const auto& [label, angle] : {std::pair(1, 60.0), std::pair(2, -60.0)}) {
    const auto points = land.coordinates->space().surface_points(land.mesh, {label}, 2);
    int seen = 0;
    double mean = 0;
    for (std::size_t q = 0; q < points.tet.size(); ++q) {
      const auto k = static_cast<Eigen::Index>(q);
      if (!in_the_body(points.X.col(k))) continue;
      ++seen;
      const Mat3 axes = helix_axes(land.coordinates->sample(points.tet[q], points.barycentric.col(k)), {});
      const auto [helix, dip] = exact_angles(axes.col(0), points.X.col(k));
      EXPECT_NEAR(helix, angle, 5);  // axes that are smoothed over elements of 3 mm
      EXPECT_NEAR(dip, 0, 6);
      mean += helix;
    }
    ASSERT_GT(seen, 100);
    EXPECT_NEAR(mean / seen, angle, 0.5);
  }
}

TEST(Helix, AnglesAreLinearInDepth) {
  const auto& land = LandEllipsoid::get();
  for (int t = 0; t < land.mesh.num_tets(); ++t) {
    const Vec3 X = land.coordinates->position(t, Vec4::Constant(0.25));
    if (!in_the_body(X)) continue;
    const CoordinateSample at = land.coordinates->sample(t, Vec4::Constant(0.25));
    EXPECT_NEAR(exact_angles(helix_axes(at, {}).col(0), X).first, 60 - 120 * at.t, 5);
    EXPECT_NEAR(exact_angles(helix_axes(at, {30, 30, 0}).col(0), X).first, 30, 5);
  }
  CoordinateSample middle;
  middle.t = 0.5;
  middle.Q << -1, 0, 0, 0, 1, 0, 0, 0, 1;  // longitudinal = radial × circumferential
  EXPECT_LT((helix_axes(middle, {}).col(0) - Vec3::UnitY()).norm(), 1e-15);  // circumferential
  middle.t = 0.25;
  EXPECT_LT((helix_axes(middle, {}).col(0) - Vec3(-0.5, std::sqrt(0.75), 0)).norm(),
            1e-15);  // 30° towards the base
}

TEST(Helix, AxesAreOrthonormalAndRightHanded) {
  const auto& land = LandEllipsoid::get();
  const auto points = land.coordinates->space().wall_points(2);
  const HelixAngles angles{70, -50, 25};
  const FibreAxes fibres = helix_fibres(*land.coordinates, points.tet, points.barycentric, angles);
  ASSERT_EQ(fibres.cols(), points.barycentric.cols());
  EXPECT_NO_THROW(require_orthonormal(fibres));
  for (Eigen::Index q = 0; q < fibres.cols(); ++q) {
    const Mat3 R = fibres.col(q).reshaped(3, 3);
    EXPECT_LT((R.transpose() * R - Mat3::Identity()).norm(), 1e-12);
    EXPECT_NEAR(R.determinant(), 1, 1e-12);
    const CoordinateSample at = land.coordinates->sample(points.tet[q], points.barycentric.col(q));
    EXPECT_EQ((R - helix_axes(at, angles)).norm(), 0);
  }
}

TEST(Helix, TheSheetTurnsAboutTheFibre) {
  const auto& land = LandEllipsoid::get();
  for (int t = 0; t < land.mesh.num_tets(); t += 5) {
    const CoordinateSample at = land.coordinates->sample(t, Vec4::Constant(0.25));
    const Vec3 radial = at.Q.col(2).normalized();
    const Mat3 plain = helix_axes(at, {60, -60, 0});
    EXPECT_LT((plain.col(1) - radial).norm(), 1e-12);
    const Mat3 turned = helix_axes(at, {60, -60, 40});
    EXPECT_LT((turned.col(0) - plain.col(0)).norm(), 1e-15);
    EXPECT_NEAR(turned.col(1).dot(radial), std::cos(40 * kDegree), 1e-12);
    EXPECT_NEAR(turned.col(1).dot(plain.col(0).cross(radial)), std::sin(40 * kDegree), 1e-12);
  }
}

TEST(Helix, OrthonormalAxesKeepTheRadialDirection) {
  const auto& land = LandEllipsoid::get();
  for (int t = 0; t < land.mesh.num_tets(); t += 5) {
    const CoordinateSample at = land.coordinates->sample(t, Vec4::Constant(0.25));
    const Mat3 axes = orthonormal_axes(at);
    EXPECT_LT((axes.transpose() * axes - Mat3::Identity()).norm(), 1e-12);
    EXPECT_NEAR(axes.determinant(), -1, 1e-12);  // longitudinal, circumferential, radial is left-handed
    EXPECT_LT((axes.col(2) - at.Q.col(2).normalized()).norm(), 1e-15);
    EXPECT_GT(axes.col(1).dot(at.Q.col(1)), 0);
  }
}

}  // namespace
}  // namespace cardiac
