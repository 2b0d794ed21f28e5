#include <gtest/gtest.h>

#include <algorithm>
#include <cardiac/circulation/elastance.hpp>
#include <cardiac/circulation/left_heart_loop.hpp>
#include <cmath>
#include <polyaffine/solve/ode.hpp>
#include <random>

namespace cardiac {
namespace {

using polyaffine::Vector;

LeftHeartLoop human_loop() {
  const double r = resistance_per_mmHg_s_per_mL, p = kPa_per_mmHg;
  return {.filling_pressure_kPa = 10 * p,
          .mitral = {.resistance_kPa_ms_per_mm3 = 0.01 * r},
          .aortic = {.resistance_kPa_ms_per_mm3 = 0.005 * r},
          .arteries = {.proximal_resistance_kPa_ms_per_mm3 = 0.03 * r,
                       .peripheral_resistance_kPa_ms_per_mm3 = 0.9 * r,
                       .compliance_mm3_per_kPa = 1.6 * compliance_per_mL_per_mmHg,
                       .reference_pressure_kPa = 5 * p}};
}

TEST(LeftHeartLoop, PartialDerivativesAreTheDerivatives) {
  const LeftHeartLoop loop = human_loop();
  std::mt19937 random(7);
  std::uniform_real_distribution<double> pressure(-1, 18), capacitor(6, 16), rate(-500, 500);
  for (int i = 0; i < 200; ++i) {
    const double v = rate(random), p = pressure(random), c = capacitor(random), dc = rate(random) / 5000;
    const double h = 1e-6;
    const LoopResidual r = loop_residual(loop, v, p, c, dc);
    const auto check = [&](double analytic, auto residual_of_shift) {
      const double difference = (residual_of_shift(h) - residual_of_shift(-h)) / (2 * h);
      EXPECT_NEAR(analytic, difference,
                  1e-4 * std::max(1.0, std::abs(analytic)));  // rounding 1e4 · 1e-16 / h
    };
    check(1, [&](double s) { return loop_residual(loop, v + s, p, c, dc).volume; });
    check(r.volume_by_pressure, [&](double s) { return loop_residual(loop, v, p + s, c, dc).volume; });
    check(r.volume_by_capacitor_pressure,
          [&](double s) { return loop_residual(loop, v, p, c + s, dc).volume; });
    check(0, [&](double s) { return loop_residual(loop, v, p, c, dc + s).volume; });
    check(0, [&](double s) { return loop_residual(loop, v + s, p, c, dc).capacitor; });
    check(r.capacitor_by_pressure, [&](double s) { return loop_residual(loop, v, p + s, c, dc).capacitor; });
    check(r.capacitor_by_capacitor_pressure,
          [&](double s) { return loop_residual(loop, v, p, c + s, dc).capacitor; });
    check(r.capacitor_by_capacitor_rate,
          [&](double s) { return loop_residual(loop, v, p, c, dc + s).capacitor; });
    EXPECT_GT(r.volume_by_pressure, 0);
    EXPECT_LT(r.volume_by_capacitor_pressure, 0);
    EXPECT_GT(r.capacitor_by_capacitor_pressure, 0);
  }
}

TEST(LeftHeartLoop, RatesMakeTheResidualVanish) {
  const LeftHeartLoop loop = human_loop();
  for (const double p : {0.5, 1.33, 8.0, 15.0}) {
    const LoopRates rates = loop_rates(loop, p, 10);
    EXPECT_GT(std::abs(rates.volume_mm3_per_ms), 1e-7);
    const LoopResidual r =
        loop_residual(loop, rates.volume_mm3_per_ms, p, 10, rates.capacitor_pressure_kPa_per_ms);
    EXPECT_NEAR(r.volume, 0, 1e-12);
    EXPECT_NEAR(r.capacitor, 0, 1e-11);
  }
}

TEST(LeftHeartLoop, ProximalResistanceCarriesTheAorticFlow) {
  const LeftHeartLoop loop = human_loop();
  const double p = 16, capacitor = 12;
  const LoopFlows flows = loop_flows(loop, p, capacitor);
  // 30 mmHg over 0.035 mmHg·s/mL; the smoothing adds ε²/(4RΔp) = 6e-4 mL/s
  EXPECT_NEAR(flows.aortic_mm3_per_ms, (p - capacitor) / (0.035 * resistance_per_mmHg_s_per_mL), 1e-3);
  EXPECT_NEAR(p - flows.aortic_pressure_kPa, flows.aortic_mm3_per_ms * 0.005 * resistance_per_mmHg_s_per_mL,
              1e-4);
  EXPECT_GT(flows.aortic_pressure_kPa, capacitor);
}

struct Beat {
  Vector time, volume, pressure, capacitor;
};

/// Beats of a ventricle with a time-varying elastance in the loop until V and p_c return; the last beat.
Beat limit_cycle(const LeftHeartLoop& loop, const Elastance& ventricle, double period) {
  const auto pressure = [&](double t, double volume) {
    return elastance_at(ventricle, period, t) * (volume - ventricle.unstressed_volume_mm3);
  };
  const auto rate = [&](double t, const Vector& y, Vector& dy) {
    const LoopRates rates = loop_rates(loop, pressure(t, y[0]), y[1]);
    dy << rates.volume_mm3_per_ms, rates.capacitor_pressure_kPa_per_ms;
  };
  const Vector times = Vector::LinSpaced(static_cast<int>(period) + 1, 0, period);
  Vector state(2);
  state << 120 * mm3_per_mL, 80 * kPa_per_mmHg;
  for (int beat = 0; beat < 50; ++beat) {
    const auto solution = polyaffine::solve_ode(
        rate, 0, state, times, {.relative_tolerance = 1e-8, .absolute_tolerance = 1e-8, .max_step = 5});
    EXPECT_TRUE(solution.finished()) << solution.message;
    const Vector end = solution.states.rightCols<1>();
    const double change = ((end - state).array() / state.array()).abs().maxCoeff();
    state = end;
    if (change < 1e-6) {
      Beat last{times, solution.states.row(0), Vector(times.size()), solution.states.row(1)};
      for (Eigen::Index i = 0; i < times.size(); ++i) last.pressure[i] = pressure(times[i], last.volume[i]);
      return last;
    }
  }
  ADD_FAILURE() << "no limit cycle within 50 beats";
  return {};
}

const Elastance human_ventricle{.active_kPa_per_mm3 = 2.2 * elastance_per_mmHg_per_mL,
                                .passive_kPa_per_mm3 = 0.08 * elastance_per_mmHg_per_mL,
                                .onset_ms = 100,
                                .contraction_ms = 300,
                                .relaxation_ms = 150,
                                .unstressed_volume_mm3 = 5 * mm3_per_mL};

std::vector<Phase> without_repetition(const std::vector<Phase>& phases) {
  std::vector<Phase> order(phases);
  order.erase(std::unique(order.begin(), order.end()), order.end());
  return order;
}

TEST(LeftHeartLoop, FourPhasesFollowOneAnotherInABeat) {
  for (const double period : {600.0, 800.0, 1500.0}) {  // the last has a long rest at the end of filling
    const LeftHeartLoop loop = human_loop();
    const Beat beat = limit_cycle(loop, human_ventricle, period);
    const auto phases = classify_phases(loop, beat.pressure, beat.capacitor);
    EXPECT_EQ(without_repetition(phases),
              (std::vector{Phase::filling, Phase::isovolumetric_contraction, Phase::ejection,
                           Phase::isovolumetric_relaxation, Phase::filling}))
        << period;

    const double largest = beat.volume.maxCoeff(), smallest = beat.volume.minCoeff();
    for (const Phase phase : {Phase::isovolumetric_contraction, Phase::isovolumetric_relaxation}) {
      const auto begin = std::find(phases.begin(), phases.end(), phase) - phases.begin();
      const auto count = std::count(phases.begin(), phases.end(), phase);
      const Vector volume = beat.volume.segment(begin, count);
      EXPECT_LT(volume.maxCoeff() - volume.minCoeff(), 0.005 * largest);
      EXPECT_GE(count, 10);
      EXPECT_LE(count, 120);  // ms
    }
    EXPECT_GT((largest - smallest) / largest, 0.4);
    const double peak = beat.pressure.maxCoeff() / kPa_per_mmHg;
    EXPECT_GT(peak, 80);
    EXPECT_LT(peak, 160);
  }
}

TEST(LeftHeartLoop, WhatEntersTheCycleLeavesIt) {
  const LeftHeartLoop loop = human_loop();
  const Beat beat = limit_cycle(loop, human_ventricle, 800);
  double filled = 0, ejected = 0, drained = 0;
  for (Eigen::Index i = 0; i + 1 < beat.time.size(); ++i) {  // trapezoidal rule on a periodic function
    const LoopFlows flows = loop_flows(loop, beat.pressure[i], beat.capacitor[i]);
    filled += flows.mitral_mm3_per_ms;
    ejected += flows.aortic_mm3_per_ms;
    drained += (beat.capacitor[i] - loop.arteries.reference_pressure_kPa) /
               loop.arteries.peripheral_resistance_kPa_ms_per_mm3;
  }
  const double stroke = beat.volume.maxCoeff() - beat.volume.minCoeff();
  // sums at 1 ms of flows with corners: 1 ms² times the jump of the slopes, about 1e-3 of the whole
  EXPECT_NEAR(filled, ejected, 2e-3 * ejected);
  EXPECT_NEAR(drained, ejected, 2e-3 * ejected);
  EXPECT_NEAR(stroke, ejected, 5e-3 * ejected);
}

TEST(LeftHeartLoop, PhasesIgnoreAnInstantOfAWrongValve) {
  const LeftHeartLoop loop = human_loop();
  const double low = 0.5, mid = 6, high = 14, capacitor = 10;
  const Vector pressure =
      (Vector(12) << low, mid, low, low, mid, mid, high, high, mid, high, mid, low).finished();
  const auto phases = classify_phases(loop, pressure, Vector::Constant(12, capacitor));
  const Phase f = Phase::filling, c = Phase::isovolumetric_contraction, e = Phase::ejection,
              r = Phase::isovolumetric_relaxation;
  // sample 1 is a blip of the mitral, sample 9 of the aortic valve
  EXPECT_EQ(phases, (std::vector{f, f, f, f, c, c, e, e, r, r, r, f}));
}

TEST(LeftHeartLoop, PhasesWithoutEjection) {
  const LeftHeartLoop loop = human_loop();
  const Vector pressure = (Vector(6) << 0.5, 5, 7, 4, 3, 0.5).finished();
  const auto phases = classify_phases(loop, pressure, Vector::Constant(6, 10));
  const Phase f = Phase::filling, c = Phase::isovolumetric_contraction, r = Phase::isovolumetric_relaxation;
  EXPECT_EQ(phases, (std::vector{f, c, r, r, r, f}));
  const Vector slack = Vector::Constant(6, 0.5);
  EXPECT_EQ(classify_phases(loop, slack, Vector::Constant(6, 10)), std::vector<Phase>(6, f));
  EXPECT_TRUE(classify_phases(loop, Vector(), Vector()).empty());
}

TEST(LeftHeartLoop, PhasesOfABeatThatBeginsInEjection) {
  const LeftHeartLoop loop = human_loop();
  const Vector pressure = (Vector(7) << 14, 14, 6, 0.5, 0.5, 6, 14).finished();
  const auto phases = classify_phases(loop, pressure, Vector::Constant(7, 10));
  const Phase f = Phase::filling, c = Phase::isovolumetric_contraction, e = Phase::ejection,
              r = Phase::isovolumetric_relaxation;
  EXPECT_EQ(phases, (std::vector{e, e, r, f, f, c, e}));
}

}  // namespace
}  // namespace cardiac
