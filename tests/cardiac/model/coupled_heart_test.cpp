#include "cardiac/model/coupled_heart.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <cardiac/core/units.hpp>
#include <cardiac/run/build_ventricle.hpp>
#include <cardiac/scene/loops.hpp>
#include <polyaffine/solve/load_stepping.hpp>

#include "support/heart_run.hpp"
#include "support/random_vector.hpp"
#include "support/tested_heart.hpp"

namespace cardiac {
namespace {

using polyaffine::Vector;
using polyaffine::testing::random_vector;
using testing::TestedHeart;

/// A beat on the coarse Land ellipsoid.
struct LandBeat {
  Protocol protocol;
  Ventricle ventricle;

  explicit LandBeat(std::vector<std::string> overrides = {})
      : protocol(testing::shipped_protocol("healthy_lv", testing::on_land_ellipsoid(std::move(overrides)))),
        ventricle(build_ventricle(testing::read_anatomy(protocol), protocol, protocol.reduction.method)) {}
};

std::shared_ptr<const CirculationModel> circulation_of(const LandBeat& beat) {
  return std::make_shared<LeftHeartCirculation>(left_heart_loop(*beat.protocol.circulation));
}

struct LoopState {
  const char* name;
  double pressure_mmHg, arterial_mmHg;
};
constexpr std::array kLoopStates{LoopState{"filling", 9.5, 80}, LoopState{"both valves closed", 50, 80},
                                 LoopState{"ejection", 82, 80}};

struct Point {
  double t;
  Vector y, rate;
};

Point random_point(const LandBeat& beat, const TestedHeart& system, const LoopState& loop, double wall_rate,
                   unsigned seed) {
  // Coefficients of 0.02 mm leave det F well above 0; at 250 ms the wall contracts.
  const Vector c = random_vector(beat.ventricle.num_coefficients(), 0.02, seed);
  const HeartState state{250, c, beat.ventricle.cavity_volumes(c),
                         kPa_per_mmHg * Vector{{loop.pressure_mmHg}},
                         kPa_per_mmHg * Vector{{loop.arterial_mmHg}}};
  Vector rate = random_vector(system.size(), 1, seed + 1);
  rate.head(c.size()) *= wall_rate;
  return {250, system.heart.pack(state), rate};
}

/// (∂R/∂y + α ∂R/∂ẏ) d by central differences.
Vector times_jacobian(const TestedHeart& system, const Point& p, double alpha, const Vector& d, double h) {
  Vector plus, minus;
  EXPECT_TRUE(system.residual(p.t, p.y + h * d, p.rate + alpha * h * d, plus));
  EXPECT_TRUE(system.residual(p.t, p.y - h * d, p.rate - alpha * h * d, minus));
  return (plus - minus) / (2 * h);
}

/// Errors of J⁻¹(J d) against d: of the wall, over its size, and the largest of V, p and p_c.
struct InversionError {
  double wall = 0, loop = 0;
};

InversionError inversion_error(TestedHeart& system, const Point& p, double alpha, unsigned seed) {
  const auto n = system.size() - 3;
  Vector d = random_vector(system.size(), 1, seed);
  d[n] *= 100;                // mm³
  const double small = 1e-5;  // so that the circulation, which is solved as it is, is linear to 1e-5
  const Vector image = times_jacobian(system, p, alpha, d, small);
  Vector x;
  EXPECT_TRUE(system.factorise(p.t, p.y, p.rate, alpha));
  EXPECT_TRUE(system.solve(p.t, p.y, p.rate, small * image, x));
  x /= small;
  return {(x - d).head(n).norm() / d.head(n).norm(),
          (x - d).tail<3>().cwiseQuotient(d.tail<3>()).cwiseAbs().maxCoeff()};
}

// Differences at a step of 1e-5 keep about eight digits; the condition of the system takes some of them.
constexpr double kExact = 1e-4;

TEST(CoupledHeart, SolveInvertsTheDerivativeOfTheResidual) {
  const LandBeat beat({"tissue.viscosity_kPa_ms=0"});
  TestedHeart system(beat.ventricle, circulation_of(beat));
  unsigned seed = 1;
  for (const LoopState& loop : kLoopStates)
    for (const double alpha : {0.05, 1.0, 20.0}) {
      SCOPED_TRACE(std::string(loop.name) + ", alpha " + std::to_string(alpha));
      const Point p = random_point(beat, system, loop, 0.01, seed);
      const InversionError error = inversion_error(system, p, alpha, seed + 7);
      EXPECT_LT(error.wall, kExact);
      EXPECT_LT(error.loop, kExact);
      seed += 10;
    }
}

TEST(CoupledHeart, SolveMeetsTheCirculationAsItIsHoweverStiffItsValves) {
  const LandBeat beat({"circulation.mitral_resistance_mmHg_s_per_mL=1e-6",
                       "circulation.aortic_valve_resistance_mmHg_s_per_mL=1e-6"});
  TestedHeart system(beat.ventricle, circulation_of(beat));
  for (const LoopState& loop : kLoopStates) {
    SCOPED_TRACE(loop.name);
    const double alpha = 1;
    const Point p = random_point(beat, system, loop, 0.01, 5);
    Vector before, step, after;
    ASSERT_TRUE(system.residual(p.t, p.y, p.rate, before));
    ASSERT_TRUE(system.factorise(p.t, p.y, p.rate, alpha));
    ASSERT_TRUE(system.solve(p.t, p.y, p.rate, -before, step));
    step.head(step.size() - 3) *= 1e-3;  // the wall's part need not be a state without inversion
    ASSERT_TRUE(system.residual(p.t, p.y + step, p.rate + alpha * step, after));
    // The inner iterations end at 1e-10 of the step; a valve of 1e-6 mmHg·s/mL makes flows of it.
    EXPECT_LT(after.tail<2>().norm(), 1e-4 * before.tail<2>().norm());
    EXPECT_GT(before.tail<2>().norm(), 0.1);
  }
}

TEST(CoupledHeart, ViscosityIsExactAtRestAndClosesInWithTheStepInMotion) {
  const LandBeat beat;
  TestedHeart system(beat.ventricle, circulation_of(beat));
  ASSERT_GT(beat.protocol.tissue.viscosity_kPa_ms, 0);
  const Point rest = random_point(beat, system, kLoopStates[1], 0, 3);
  const InversionError error = inversion_error(system, rest, 1, 5);
  EXPECT_LT(error.wall, kExact);
  EXPECT_LT(error.loop, kExact);
  // The derivative of the viscous stress by the displacement is left out. In the wall it counts as 1/α once
  // the viscous stiffness αη outweighs the elastic one, and only the wall's error comes back in an iteration.
  const Point moving = random_point(beat, system, kLoopStates[1], 0.02, 3);
  const double slow = inversion_error(system, moving, 20, 5).wall;
  const double fast = inversion_error(system, moving, 400, 5).wall;
  EXPECT_GT(slow, 1e-6);
  EXPECT_LT(fast, slow / 8);
}

TEST(CoupledHeart, ResidualIsThatOfItsParts) {
  const LandBeat beat;
  TestedHeart system(beat.ventricle, circulation_of(beat));
  Point p = random_point(beat, system, kLoopStates[1], 0, 11);
  Vector r;
  ASSERT_TRUE(system.residual(p.t, p.y, p.rate, r));
  const auto n = system.size() - 3;
  EXPECT_NEAR(r[n], 0, 1e-9);              // packed with the cavity's own volume
  EXPECT_NEAR(r[n + 2], p.rate[n], 5e-3);  // closed valves: V̇ alone, but for their leak (1.6e-3 at 40 mmHg)
  const Vector before = r.head(n);
  const Vector g = beat.ventricle.cavities[0].volume->evaluate({Vector(p.y.head(n))}).gradient;
  p.y[n + 2] += 1;
  ASSERT_TRUE(system.residual(p.t, p.y, p.rate, r));
  EXPECT_LT((r.head(n) - before + g).norm(), 1e-9 * g.norm());  // pressure pushes outwards
  EXPECT_GT(g.norm(), 0);
  p.y.head(n) *= 1e4;
  EXPECT_FALSE(system.residual(p.t, p.y, p.rate, r));  // turned inside out
}

TEST(CoupledHeart, StartIsConsistentWithTheFlowOfTheValves) {
  for (const char* viscosity : {"100", "0"}) {
    SCOPED_TRACE(viscosity);
    const LandBeat beat({std::string("tissue.viscosity_kPa_ms=") + viscosity});
    const LeftHeartLoop loop = left_heart_loop(*beat.protocol.circulation);
    TestedHeart system(beat.ventricle, circulation_of(beat));
    const Vector rest = beat.ventricle.contraction->tension(0);
    Vector c = Vector::Zero(beat.ventricle.num_coefficients());
    const auto filling = loaded_ventricle(beat.ventricle, {Vector{{loop.filling_pressure_kPa}}, rest});
    ASSERT_TRUE(polyaffine::load_stepping(filling, *filling.make_linear(), c).converged());
    Vector y = system.heart.pack({0, c, beat.ventricle.cavity_volumes(c), Vector{{loop.filling_pressure_kPa}},
                                  Vector{{80 * kPa_per_mmHg}}});
    const auto n = c.size();
    Vector at_rest, start;
    ASSERT_TRUE(system.residual(0, y, Vector::Zero(system.size()), at_rest));
    EXPECT_GT(std::abs(at_rest[n + 2]), 1e-2);  // the mitral valve lets blood through
    Vector rate = Vector::Zero(system.size());
    make_consistent(system.heart, *system.heart.system.make_linear(), 0, y, rate);
    ASSERT_TRUE(system.residual(0, y, rate, start));
    const Vector g = beat.ventricle.cavities[0].volume->evaluate({c}).gradient;
    EXPECT_LT(start.head(n).norm(), 1e-6 * loop.filling_pressure_kPa * g.norm());
    EXPECT_NEAR(start[n + 1], 0, 1e-9);
    EXPECT_NEAR(start[n + 2], 0, 1e-9);
    EXPECT_NEAR(g.dot(rate.head(n)), rate[n], 1e-6 * std::abs(rate[n]));
    EXPECT_GT(rate[n], 0);
  }
}

TEST(CoupledHeart, ClosedVentricleKeepsItsVolumeThroughABeat) {
  // Arteries under a pressure that the ventricle does not reach: it contracts and relaxes at one volume.
  const testing::HeartRun& healthy = testing::shipped_run("healthy_lv");
  Protocol protocol = healthy.protocol;
  protocol.circulation->initial_aortic_pressure_kPa = 1000 * kPa_per_mmHg;
  protocol.circulation->peripheral_resistance_kPa_ms_per_mm3 = 10 * resistance_per_mmHg_s_per_mL;
  protocol.time.max_beats = 1;
  const HeartPath path = run_beats(healthy.ventricle, protocol);
  ASSERT_TRUE(path.completed) << path.stop_reason;
  double peak = 0, low = 1e300, high = 0;
  for (const HeartState& s : path.steps) {
    peak = std::max(peak, s.pressures_kPa[0] / kPa_per_mmHg);
    low = std::min(low, s.volumes_mm3[0]);
    high = std::max(high, s.volumes_mm3[0]);
    ASSERT_LT(s.pressures_kPa[0], s.vessels_kPa[0]);
  }
  EXPECT_GT(peak, 150);
  EXPECT_LT(high - low, 0.005 * high);
}

}  // namespace
}  // namespace cardiac
