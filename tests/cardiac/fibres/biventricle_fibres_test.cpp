#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include <cardiac/fibres/helix.hpp>

#include "support/biventricle.hpp"

namespace cardiac {
namespace {

using polyaffine::kPi;
using polyaffine::Mat3;
using polyaffine::Vec3;
using polyaffine::Vec4;
using testing::Biventricle;

HelixAngles angles() {
  HelixAngles out;
  out.rv_endo_deg = 40;
  out.rv_epi_deg = -50;
  return out;
}

// Degrees from circumferential towards the base, in the axes of the ventricle.
double helix_deg(const CoordinateSample& at, const Vec3& f) {
  const Vec3 local = orthonormal_axes(at).transpose() * f;
  return 180 / kPi * std::atan(local[0] / local[1]);
}

TEST(BiventricleFibres, AxesAreOrthonormalEverywhere) {
  const auto& both = Biventricle::get();
  for (int t = 0; t < both.mesh.num_tets(); ++t)
    for (const Vec4& at : {Vec4(0.25, 0.25, 0.25, 0.25), Vec4(1, 0, 0, 0), Vec4(0.1, 0, 0.9, 0)}) {
      const Mat3 R = wall_fibres(*both.coordinates, t, at, angles());
      ASSERT_LT((R.transpose() * R - Mat3::Identity()).norm(), 1e-12);
      ASSERT_GT(R.determinant(), 0);
    }
}

TEST(BiventricleFibres, AnglesAreThoseOfEachVentricle) {
  const auto& both = Biventricle::get();
  const auto& c = *both.coordinates;
  const struct {
    int label;
    bool right;
    double angle;
  } surfaces[] = {{kEndocardium, false, 60},
                  {kEpicardium, false, -60},
                  {kRvEndocardium, true, 40},
                  {kEpicardium, true, -50}};
  for (const auto& s : surfaces) {
    const auto points = c.space().surface_points(both.mesh, {s.label}, 2);
    double mean = 0;
    int seen = 0;
    for (std::size_t q = 0; q < points.tet.size(); ++q) {
      const Vec4 at = points.barycentric.col(static_cast<Eigen::Index>(q));
      const double share = c.right()->border(points.tet[q], at).share;
      const double height = c.long_axis_height(c.position(points.tet[q], at));
      if (height < 0.3 || (s.right ? share < 1 : share > 0)) continue;
      const Vec3 f = wall_fibres(c, points.tet[q], at, angles()).col(0);
      mean += helix_deg(s.right ? c.right_sample(points.tet[q], at) : c.sample(points.tet[q], at), f);
      ++seen;
    }
    ASSERT_GT(seen, 50);
    EXPECT_NEAR(mean / seen, s.angle, 1.5) << s.label << s.right;
  }
}

TEST(BiventricleFibres, SeptumTurnsWithoutAJump) {
  const auto& both = Biventricle::get();
  const auto& c = *both.coordinates;
  int seen = 0;
  for (int t = 0; t < both.mesh.num_tets(); ++t)
    for (int k = 0; k < 4; ++k) {
      const int other = both.mesh.neighbours()(k, t);
      if (other < t || both.mesh.regions()[t] != kSeptum || both.mesh.regions()[other] != kSeptum) continue;
      const Vec4 centre = Vec4::Constant(0.25);
      if (c.long_axis_height(both.mesh.tet_centroid(t)) < 0.2) continue;
      const Vec3 a = wall_fibres(c, t, centre, angles()).col(0),
                 b = wall_fibres(c, other, centre, angles()).col(0);
      const double depth = std::abs(c.sample(t, centre).t - c.sample(other, centre).t);
      const double turn = 180 / kPi * std::acos(std::min(1.0, std::abs(a.dot(b))));
      EXPECT_LT(turn, 120 * depth + 20);  // 120° through the septum, and some along it
      ++seen;
    }
  EXPECT_GT(seen, 500);
}

}  // namespace
}  // namespace cardiac
