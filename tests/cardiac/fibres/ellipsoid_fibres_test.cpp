#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cardiac/fibres/ellipsoid_fibres.hpp>
#include <cmath>
#include <polyaffine/core/error.hpp>

#include "support/land_ellipsoid.hpp"

namespace cardiac {
namespace {

using polyaffine::kPi;
using polyaffine::Mat3;

const std::vector<TruncatedEllipsoid> kShapes{land_ellipsoid(), human_lv()};

// Land's parametrisation, u in [−π, 0].
Vec3 position(const TruncatedEllipsoid& s, double t, double u, double v) {
  const double rs = s.endo_short_mm + t * (s.epi_short_mm - s.endo_short_mm);
  const double rl = s.endo_long_mm + t * (s.epi_long_mm - s.endo_long_mm);
  return {rs * std::sin(u) * std::cos(v), rs * std::sin(u) * std::sin(v), rl * std::cos(u)};
}

TEST(EllipsoidFibres, DepthInvertsTheParametrisation) {
  for (const auto& s : kShapes)
    for (const double t : {-0.1, 0.0, 0.3, 0.7, 1.0, 1.1})
      for (const double u : {-kPi, -3.0, -2.0, -1.6, -kPi / 2})
        EXPECT_NEAR(ellipsoid_depth(s, position(s, t, u, 0.4)), t, 1e-12);
  EXPECT_THROW(ellipsoid_depth(land_ellipsoid(), Vec3::Zero()), polyaffine::InputError);
}

// The axes are the normalised derivatives of the parametrisation, here by central differences.
TEST(EllipsoidFibres, AxesAreTheDerivativesOfTheParametrisation) {
  constexpr double h = 1e-6;
  for (const auto& s : kShapes)
    for (const double t : {0.0, 0.4, 1.0})
      for (const double u : {-3.1, -2.2, -1.4})
        for (const double v : {-2.5, 0.3, 1.9}) {
          const CoordinateSample at = ellipsoid_sample(s, position(s, t, u, v));
          const Vec3 l = (position(s, t, u + h, v) - position(s, t, u - h, v)).normalized();
          const Vec3 c = (position(s, t, u, v + h) - position(s, t, u, v - h)).normalized();
          EXPECT_LT((at.Q.col(0) - l).norm(), 1e-8);
          EXPECT_LT((at.Q.col(1) - c).norm(), 1e-8);
          EXPECT_LT((at.Q.col(2) - c.cross(l)).norm(), 1e-8);
          EXPECT_GT(at.Q.col(0).z(), 0) << "towards the base";
        }
}

TEST(EllipsoidFibres, TurnFromPlusToMinusThroughTheWall) {
  const auto s = land_ellipsoid();
  const Vec3 endo(7, 0, 0), middle(8.5, 0, 0), epi(10, 0, 0);
  Points X(3, 3);
  X << endo, middle, epi;
  const FibreAxes land = ellipsoid_fibres(s, {90, -90}, X);
  EXPECT_LT((land.col(0).head<3>() - Vec3(0, 0, 1)).norm(), 1e-12);
  EXPECT_LT((land.col(1).head<3>() - Vec3(0, 1, 0)).norm(), 1e-12);
  EXPECT_LT((land.col(2).head<3>() - Vec3(0, 0, -1)).norm(), 1e-12);
  const FibreAxes bench = ellipsoid_fibres(s, {60, -60}, X);
  EXPECT_LT((bench.col(0).head<3>() - Vec3(0, 0.5, std::sqrt(0.75))).norm(), 1e-12);
  EXPECT_LT((bench.col(2).head<3>() - Vec3(0, 0.5, -std::sqrt(0.75))).norm(), 1e-12);
  EXPECT_LT((bench.col(0).segment<3>(3) - Vec3(1, 0, 0)).norm(), 1e-12) << "sheet across the wall";
}

TEST(EllipsoidFibres, OrthonormalEverywhereTheApexIncluded) {
  const auto s = land_ellipsoid();
  Points X(3, 4);
  X << Vec3(0, 0, -17), Vec3(0, 0, -18.3), Vec3(1e-9, -1e-9, -20), Vec3(3, -4, -13);
  EXPECT_NO_THROW(require_orthonormal(ellipsoid_fibres(s, {90, -90}, X)));
}

TEST(EllipsoidFibres, AgreeWithTheCoordinatesOfAMesh) {
  const auto& land = testing::LandEllipsoid::get();
  double worst = 0;
  for (int t = 0; t < land.mesh.num_tets(); ++t) {
    const Vec3 X = land.mesh.tet_centroid(t);
    if (X.z() < -12) continue;  // the Laplace coordinates of the apex cap are another family
    const Mat3 exact = ellipsoid_sample(land_ellipsoid(), X).Q;
    const Mat3 mesh = orthonormal_axes(land.coordinates->sample(t, polyaffine::Vec4::Constant(0.25)));
    worst = std::max(worst, (exact - mesh).cwiseAbs().maxCoeff());
  }
  EXPECT_LT(worst, 0.3);
}

}  // namespace
}  // namespace cardiac
