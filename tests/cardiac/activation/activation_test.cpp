#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <cardiac/activation/activation.hpp>
#include <polyaffine/core/error.hpp>
#include "polyaffine/geometry/box_mesh.hpp"

namespace cardiac {
namespace {

using polyaffine::box_mesh;
using polyaffine::InputError;
using polyaffine::Points;
using polyaffine::TetMesh;
using polyaffine::Vec3;
using polyaffine::Vector;

const ConductionVelocity kVelocity{0.6, 0.2};

// A slab of 40 × 40 × 4 mm with fibres along x, in 2 mm cells.
struct Slab {
  TetMesh mesh = box_mesh(Vec3(-20, -20, 0), Vec3(20, 20, 4), {20, 20, 2});
  Points fibre = Vec3::UnitX().replicate(1, mesh.num_tets());

  double time_at(const Vector& times, const Vec3& x) const {
    Eigen::Index v = 0;
    const double gap = (mesh.points().colwise() - x).colwise().norm().minCoeff(&v);
    EXPECT_LT(gap, 1e-9);
    return times[v];
  }
};

TEST(Activation, RunsAlongAndAcrossFibresAtTheGivenVelocities) {
  const Slab slab;
  const Vector times = activation_times(slab.mesh, slab.fibre, kVelocity, {{Vec3(0, 0, 2), 10}});
  // With constant fibres in a convex slab the times are those of an ellipse, exact but for rounding.
  EXPECT_NEAR(slab.time_at(times, Vec3(18, 0, 2)), 10 + 18 / 0.6, 1e-9);
  EXPECT_NEAR(slab.time_at(times, Vec3(-18, 0, 2)), 10 + 18 / 0.6, 1e-9);
  EXPECT_NEAR(slab.time_at(times, Vec3(0, 18, 2)), 10 + 18 / 0.2, 1e-9);
  for (const Vec3& x : {Vec3(12, 4, 2), Vec3(-12, 8, 4), Vec3(6, -12, 0), Vec3(18, 18, 4)}) {
    const Vec3 d = x - Vec3(0, 0, 2);
    const double exact = std::sqrt(d[0] * d[0] / 0.36 + (d[1] * d[1] + d[2] * d[2]) / 0.04);
    EXPECT_NEAR(slab.time_at(times, x) - 10, exact, 1e-9 * exact) << x.transpose();
  }
}

TEST(Activation, FollowsTurnedFibres) {
  const Slab slab;
  const Vec3 f = Vec3(1, 1, 0).normalized();
  const Vector times =
      activation_times(slab.mesh, f.replicate(1, slab.mesh.num_tets()), kVelocity, {{Vec3(0, 0, 2), 0}});
  const double along = slab.time_at(times, Vec3(12, 12, 2)), across = slab.time_at(times, Vec3(12, -12, 2));
  EXPECT_NEAR(along, 12 * std::sqrt(2.0) / 0.6, 0.03 * along);
  EXPECT_NEAR(across, 12 * std::sqrt(2.0) / 0.2, 0.12 * across);
}

TEST(Activation, TakesTheEarliestOfSeveralSitesAndMovesThemToTheMesh) {
  const Slab slab;
  const std::vector<ActivationSite> sites{{Vec3(-20, 0, 2), 0},
                                          {Vec3(20, 0, 6), 20}};  // one 2 mm above the slab
  const Vector times = activation_times(slab.mesh, slab.fibre, kVelocity, sites);
  EXPECT_NEAR(slab.time_at(times, Vec3(-20, 0, 2)), 0, 1e-12);
  EXPECT_NEAR(slab.time_at(times, Vec3(20, 0, 4)), 20, 1e-12);
  EXPECT_NEAR(slab.time_at(times, Vec3(-8, 0, 2)), 20, 1e-9);
  EXPECT_NEAR(slab.time_at(times, Vec3(8, 0, 4)), 40, 1e-9);
}

TEST(Activation, RejectsBadInput) {
  const Slab slab;
  const std::vector<ActivationSite> site{{Vec3(0, 0, 2), 0}};
  EXPECT_THROW(activation_times(slab.mesh, slab.fibre, kVelocity, {}), InputError);
  EXPECT_THROW(activation_times(slab.mesh, slab.fibre, kVelocity, {{Vec3(0, 0, 30), 0}}), InputError);
  EXPECT_THROW(activation_times(slab.mesh, slab.fibre, kVelocity,
                                {{Vec3(0, 0, 2), std::numeric_limits<double>::quiet_NaN()}}),
               InputError);
  EXPECT_THROW(activation_times(slab.mesh, slab.fibre, {0.6, 0}, site), InputError);
  EXPECT_THROW(activation_times(slab.mesh, 2 * slab.fibre, kVelocity, site), InputError);
  EXPECT_THROW(activation_times(slab.mesh, slab.fibre.leftCols(3), kVelocity, site), InputError);
  EXPECT_THROW(activation_times(slab.mesh, Points(3, 0), kVelocity, site), InputError);
}

TEST(ActivationMap, GivesItsTimesAtItsPointsAndMeansBetween) {
  const Slab slab;
  ActivationMap map{slab.mesh.points(), Vector(slab.mesh.num_points())};
  for (int i = 0; i < slab.mesh.num_points(); ++i) map.times_ms[i] = 50 + slab.mesh.points()(0, i);
  EXPECT_EQ(mapped_times(slab.mesh, map), map.times_ms);
  map.points = map.points.rowwise().reverse().eval();  // in another order
  map.times_ms.reverseInPlace();
  const Vector again = mapped_times(slab.mesh, map);
  EXPECT_NEAR(slab.time_at(again, Vec3(-20, 0, 2)), 30, 1e-12);
  const ActivationMap two{(Points(3, 2) << -10, 10, 0, 0, 2, 2).finished(), Vector{{10, 30}}};
  const Vector between = mapped_times(slab.mesh, two);
  EXPECT_NEAR(slab.time_at(between, Vec3(0, 0, 2)), 20, 1e-12);
  EXPECT_NEAR(slab.time_at(between, Vec3(4, 0, 2)), (10.0 / 196 + 30.0 / 36) / (1.0 / 196 + 1.0 / 36), 1e-12);
}

TEST(ActivationMap, SaysWhatIsMissing) {
  const Slab slab;
  const ActivationMap far{(Points(3, 1) << 100, 0, 0).finished(), Vector{{5}}};
  EXPECT_THAT([&] { mapped_times(slab.mesh, far); },
              testing::ThrowsMessage<InputError>(testing::HasSubstr("expected one within 30 mm")));
  polyaffine::MeshFile file{slab.mesh};
  file.point_fields["lat"] = polyaffine::Matrix::Constant(1, slab.mesh.num_points(), 0.04);
  file.point_fields["velocity"] = polyaffine::Matrix::Ones(3, slab.mesh.num_points());
  EXPECT_EQ(map_of_array(file, "lat", 1000, "heart.vtu").times_ms,
            Vector::Constant(slab.mesh.num_points(), 40));
  EXPECT_THAT([&] { map_of_array(file, "activation", 1, "heart.vtu"); },
              testing::ThrowsMessage<InputError>(
                  testing::HasSubstr("heart.vtu: found no point array \"activation\", expected one of "
                                     "activation times; there are lat, velocity")));
  EXPECT_THAT([&] { map_of_array(file, "velocity", 1, "heart.vtu"); },
              testing::ThrowsMessage<InputError>(testing::HasSubstr("found 3 components")));
}

}  // namespace
}  // namespace cardiac
