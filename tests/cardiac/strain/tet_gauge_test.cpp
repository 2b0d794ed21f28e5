#include "cardiac/strain/tet_gauge.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cardiac/fibres/helix.hpp>

#include "support/land_ellipsoid.hpp"
#include "support/random_vector.hpp"

namespace cardiac {
namespace {

using polyaffine::Mat3;
using polyaffine::Points;
using polyaffine::Vec3;
using polyaffine::Vec4;
using testing::LandEllipsoid;

const LandEllipsoid& land() {
  return LandEllipsoid::get();
}

Mat3 some_map(unsigned seed) {
  return Mat3::Identity() + polyaffine::testing::random_vector(9, 0.2, seed).reshaped(3, 3);
}

TEST(TetGauge, StrainIsTheChangeOfLengthOfTheLocalAxes) {
  const Mat3 F = some_map(1);
  const Points X = land().mesh.points();
  const Points strain = TetGauge(land().mesh, *land().coordinates, X).strain(F * X);
  for (int t = 0; t < land().mesh.num_tets(); ++t) {
    const Mat3 axes = orthonormal_axes(land().coordinates->wall_sample(t, Vec4::Constant(0.25)));
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(strain(k, t), (F * axes.col(k)).norm() - 1, 1e-10);
  }
}

TEST(TetGauge, StrainIsAgainstEndDiastoleInAxesThatTurnWithIt) {
  const Mat3 turn = Eigen::AngleAxisd(0.9, Vec3(1, -2, 1).normalized()).toRotationMatrix();
  const Mat3 F = some_map(2);
  const Points X = land().mesh.points();
  const Points plain = TetGauge(land().mesh, *land().coordinates, X).strain(F * X);
  const TetGauge turned(land().mesh, *land().coordinates, turn * X);
  EXPECT_LT((turned.strain(turn * F * X) - plain).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_LT(turned.strain(turn * X).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(TetGauge, DirectionsAreCarriedAlong) {
  const Mat3 F = some_map(3);
  const Points X = land().mesh.points();
  const Points f = Vec3(0.6, 0, 0.8).replicate(1, land().mesh.num_tets());
  const Points found = TetGauge(land().mesh, *land().coordinates, X).turned(f, F * X);
  const Vec3 expected = (F * f.col(0)).normalized();
  EXPECT_LT((found.colwise() - expected).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_GT((expected - f.col(0)).norm(), 0.01);
}

}  // namespace
}  // namespace cardiac
