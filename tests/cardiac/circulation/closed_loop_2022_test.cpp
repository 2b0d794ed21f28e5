#include <gtest/gtest.h>

#include <cardiac/circulation/closed_loop_2022.hpp>
#include <cardiac/core/units.hpp>
#include <polyaffine/solve/ode.hpp>
#include <random>

namespace cardiac {
namespace {

using polyaffine::Vector;

ClosedLoopState elastance_rates(const ClosedLoop& loop, double time, const ClosedLoopState& y) {
  return closed_loop_rates(loop, time, y, chamber_pressure(loop, loop.lv, time, y[volume_lv]),
                           chamber_pressure(loop, loop.rv, time, y[volume_rv]));
}

TEST(ClosedLoop2022, ReturnsToThePublishedLimitCycle) {
  const ClosedLoop loop = healthy_closed_loop();
  const ClosedLoopState initial = healthy_closed_loop_state();
  const double begin_of_last = 9 * loop.period_ms, end = 10 * loop.period_ms;
  const auto rate = [&](double t, const Vector& y, Vector& dy) { dy = elastance_rates(loop, t, y); };
  // The largest step keeps CVODE from stepping over the kinks of the elastances.
  const auto solution =
      polyaffine::solve_ode(rate, 0, initial, Vector::LinSpaced(801, begin_of_last, end),
                            {.relative_tolerance = 1e-8, .absolute_tolerance = 1e-7, .max_step = 5});
  ASSERT_TRUE(solution.finished()) << solution.message;

  const ClosedLoopState final = solution.states.col(800);
  for (int i = 0; i < closed_loop_size; ++i) {
    EXPECT_NEAR(final[i] / initial[i], 1, 1e-3) << "state " << i;  // as published
  }
  EXPECT_NEAR(blood_volume(loop, final), blood_volume(loop, initial), 1e-6 * blood_volume(loop, initial));

  const Vector lv_volume = solution.states.row(volume_lv).transpose() / mm3_per_mL;
  double peak = 0;
  for (int i = 0; i <= 800; ++i) {
    const double pressure = chamber_pressure(loop, loop.lv, begin_of_last + i, solution.states(volume_lv, i));
    peak = std::max(peak, pressure / kPa_per_mmHg);
  }
  // half a unit of the last published digit
  EXPECT_NEAR(lv_volume.minCoeff(), 66.96, 0.005);
  EXPECT_NEAR(lv_volume.maxCoeff(), 136.74, 0.005);
  EXPECT_NEAR(peak, 119.68, 0.005);
}

TEST(ClosedLoop2022, ConservesBloodInEveryState) {
  const ClosedLoop loop = healthy_closed_loop();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> factor(0.7, 1.3);
  for (int i = 0; i < 20; ++i) {
    const ClosedLoopState state =
        healthy_closed_loop_state().unaryExpr([&](double value) { return value * factor(random); });
    const ClosedLoopState rates = closed_loop_rates(loop, 40.0 * i, state, 10 + i, 3);
    EXPECT_GT(rates.cwiseAbs().maxCoeff(), 1e-3);
    // the volume is linear in the state; rounding of valve flows of up to 10⁵ mm³/ms
    EXPECT_NEAR(blood_volume(loop, rates), 0, 1e-9);
  }
}

TEST(ClosedLoop2022, ElastanceRisesAndFallsAsPublished) {
  const Elastance e{.active_kPa_per_mm3 = 3,
                    .passive_kPa_per_mm3 = 1,
                    .onset_ms = 700,
                    .contraction_ms = 200,
                    .relaxation_ms = 100};
  const auto at = [&](double t) { return elastance_at(e, 800, t); };
  EXPECT_DOUBLE_EQ(at(699), 1);
  EXPECT_NEAR(at(0), 2.5, 1e-12);    // half of the contraction, across the end of the period
  EXPECT_NEAR(at(900), 4, 1e-12);    // top
  EXPECT_NEAR(at(150), 2.5, 1e-12);  // half of the relaxation
  EXPECT_DOUBLE_EQ(at(201), 1);
}

}  // namespace
}  // namespace cardiac
