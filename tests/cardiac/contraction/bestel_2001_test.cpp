#include <gtest/gtest.h>

#include <cardiac/contraction/bestel_2001.hpp>
#include <cmath>
#include <polyaffine/core/error.hpp>
#include <random>
#include <vector>

namespace cardiac {
namespace {

constexpr double kPeriod = 1000;

/// begin, begin + step, … below end.
std::vector<double> times(double begin, double end, double step) {
  std::vector<double> result(static_cast<std::size_t>(std::ceil((end - begin) / step)));
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = begin + static_cast<double>(i) * step;
  return result;
}

/// ∫ g over [a, b] by composite five-point Gauss–Legendre, exact to 10⁻¹³ for the smooth pieces used here.
template <class Function>
double integral(const Function& g, double a, double b, int pieces) {
  constexpr double x[] = {0, 0.5384693101056831, 0.9061798459386640};
  constexpr double w[] = {0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  const double half = 0.5 * (b - a) / pieces;
  double sum = 0;
  for (int i = 0; i < pieces; ++i) {
    const double middle = a + (2 * i + 1) * half;
    sum += w[0] * g(middle);
    for (int k : {1, 2}) sum += w[k] * (g(middle - half * x[k]) + g(middle + half * x[k]));
  }
  return sum * half;
}

/// Variation of constants. While a > 0, σ₀ − τ decays with ∫a; while a < 0, τ decays with ∫|a|; so with
/// A₊, A₋ the integrals over contraction and relaxation the periodic state has
/// τ(begin) = τ(end) e^{−A₋}, σ₀ − τ(end) = (σ₀ − τ(begin)) e^{−A₊}.
double exact_periodic_tension(const BestelParameters& p, const TensionCurve& curve, double time) {
  const double begin = curve.contraction_begin_ms(), end = curve.contraction_end_ms();
  const auto decay = [&](double from, double to) {
    return std::exp(
        -integral([&](double t) { return std::abs(activation_rate(p, kPeriod, t)); }, from, to, 400));
  };
  const double rise = decay(begin, end), fall = decay(end, begin + kPeriod);
  const double at_end = p.contractility_kPa * (1 - rise) / (1 - rise * fall);
  if (time >= end) return at_end * decay(end, time);
  return p.contractility_kPa - (p.contractility_kPa - at_end * fall) * decay(begin, time);
}

TEST(Bestel, BenchmarkPeakTension) {
  const TensionCurve curve({}, kPeriod);
  EXPECT_NEAR(curve.peak_tension(), 118.1, 0.05);  // published to four digits (Aróstica et al. 2025)
  double largest = 0;
  for (const double t : times(0, kPeriod, 0.1)) largest = std::max(largest, curve.at(t).tension_kPa);
  EXPECT_NEAR(largest, curve.peak_tension(), 1e-3);  // τ̇ = 0 at the peak: O(0.1² ms²)
}

TEST(Bestel, ActivationRateHasTheTwoPublishedLevels) {
  const BestelParameters p;
  EXPECT_NEAR(activation_rate(p, kPeriod, 320), 0.005,
              1e-12);  // tanh saturated, 32 widths from both switches
  EXPECT_NEAR(activation_rate(p, kPeriod, 820), -0.030, 1e-12);
  EXPECT_NEAR(contraction_indicator(p, kPeriod, 160), 0.5, 1e-12);
  EXPECT_NEAR(contraction_indicator(p, kPeriod, 484), 0.5, 1e-12);
}

TEST(Bestel, CurveIsTheVariationOfConstantsSolution) {
  const BestelParameters p;
  const TensionCurve curve(p, kPeriod);
  for (const double t : times(curve.contraction_begin_ms(), curve.contraction_begin_ms() + kPeriod, 3.137)) {
    // solver tolerance 1e-10 and Hermite error h⁴/384 τ⁗ with h = γ/20: below 1e-6 σ₀
    EXPECT_NEAR(curve.at(t).tension_kPa, exact_periodic_tension(p, curve, t), 1e-6 * p.contractility_kPa)
        << t;
  }
}

TEST(Bestel, ShortPeriodKeepsARemainderOfTheLastBeat) {
  // 420 ms (143 / min): 96 ms of relaxation leave about e^{−0.030·96} = 6 % of the peak.
  const BestelParameters p;
  const TensionCurve curve(p, 420);
  const double remainder = curve.at(curve.contraction_begin_ms()).tension_kPa;
  EXPECT_GT(remainder, 0.04 * curve.peak_tension());
  EXPECT_LT(remainder, 0.10 * curve.peak_tension());
  EXPECT_GT(curve.peak_tension(), TensionCurve(p, kPeriod).peak_tension());
  const double seam = curve.contraction_begin_ms() + 420;
  EXPECT_NEAR(curve.at(seam - 1e-9).tension_kPa, curve.at(seam + 1e-9).tension_kPa, 1e-7);
}

TEST(Bestel, RateIsTheDerivativeAndSatisfiesTheEquation) {
  const BestelParameters p;
  const TensionCurve curve(p, kPeriod);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any_time(0, kPeriod);
  double largest = 0;
  for (int i = 0; i < 500; ++i) {
    const double t = any_time(random), h = 1e-3;
    const auto sample = curve.at(t);
    const double difference = (curve.at(t + h).tension_kPa - curve.at(t - h).tension_kPa) / (2 * h);
    EXPECT_NEAR(sample.rate_kPa_per_ms, difference, 1e-5);  // h times the largest jump of τ̈, 1e-2 kPa/ms²
    // slope error of the Hermite pieces is of third order in γ/20
    EXPECT_NEAR(sample.rate_kPa_per_ms, tension_rate(p, kPeriod, t, sample.tension_kPa), 1e-4);
    largest = std::max(largest, std::abs(sample.rate_kPa_per_ms));
  }
  EXPECT_GT(largest, 1);
}

TEST(Bestel, IsPeriodicForAnyTime) {
  const TensionCurve curve({}, kPeriod);
  for (const double t : {0.0, 170.3, 300.0, 480.9, 500.0, 999.9}) {
    for (const int beats : {-3, -1, 1, 7}) {
      // rounding of t + 7000 ms times the steepest slope
      EXPECT_NEAR(curve.at(t).tension_kPa, curve.at(t + beats * kPeriod).tension_kPa, 1e-10);
    }
  }
}

TEST(Bestel, IsZeroBeforeContraction) {
  const TensionCurve curve({}, kPeriod);
  for (const double t : times(0, 140, 5)) {
    const double tension = curve.at(t).tension_kPa;
    EXPECT_GE(tension, 0);
    EXPECT_LT(tension, 1e-4);  // 118 kPa · exp(−0.030 · 500) = 4e-5 left of the last beat
  }
}

TEST(Bestel, DelayShiftsAndScaleMultiplies) {
  const TensionCurve curve({}, kPeriod);
  const Vector delay = (Vector(4) << 0, 35.5, 980, -20).finished();
  const Vector scale = (Vector(4) << 1, 0.5, 1.2, 0).finished();
  Vector tension(4), rate(4);
  for (const double t : {5.0, 200.0, 455.0}) {
    curve.evaluate(t, delay, scale, tension, rate);
    for (int i = 0; i < 4; ++i) {
      EXPECT_DOUBLE_EQ(tension[i], scale[i] * curve.at(t - delay[i]).tension_kPa);
      EXPECT_DOUBLE_EQ(rate[i], scale[i] * curve.at(t - delay[i]).rate_kPa_per_ms);
    }
  }
  BestelParameters later;
  later.systole_ms += 35.5;
  later.diastole_ms += 35.5;
  const TensionCurve shifted(later, kPeriod);
  for (const double t : times(0, kPeriod, 7.3)) {
    EXPECT_NEAR(shifted.at(t).tension_kPa, curve.at(t - 35.5).tension_kPa, 1e-6);  // two solver runs at 1e-10
  }
}

TEST(Bestel, IsLinearInContractility) {
  BestelParameters doubled;
  doubled.contractility_kPa *= 2;
  const TensionCurve one({}, kPeriod), two(doubled, kPeriod);
  for (const double t : times(0, kPeriod, 7.3))
    EXPECT_NEAR(two.at(t).tension_kPa, 2 * one.at(t).tension_kPa, 1e-7);
}

TEST(Bestel, ContractionAcrossTheEndOfThePeriod) {
  BestelParameters p;
  p.systole_ms = 900;
  p.diastole_ms = 1224;
  const TensionCurve across(p, kPeriod), reference({}, kPeriod);
  EXPECT_NEAR(across.at(100).tension_kPa, reference.at(360).tension_kPa, 1e-6);
  EXPECT_NEAR(across.peak_tension(), reference.peak_tension(), 1e-6);
}

TEST(Bestel, RejectsParametersWithoutMeaning) {
  const auto rejects = [](auto change, double period = kPeriod) {
    BestelParameters p;
    change(p);
    EXPECT_THROW(TensionCurve(p, period), polyaffine::InputError);
  };
  rejects([](auto& p) { p.activation_rate_per_ms = -1; });
  rejects([](auto& p) { p.contractility_kPa = -1; });
  rejects([](auto& p) { p.steepness_ms = std::nan(""); });
  rejects([](auto& p) { p.diastole_ms = p.systole_ms; });
  rejects([](auto& p) { p.diastole_ms = p.systole_ms + 5; });  // shorter than the switches are wide
  rejects([](auto&) {}, 300);                                  // next contraction before relaxation
  rejects([](auto&) {}, 325);                                  // one millisecond to relax
}

TEST(TensionCurve, WithoutContractilityThereIsNone) {
  BestelParameters p;
  p.contractility_kPa = 0;
  const TensionCurve curve(p, 800);
  for (const double t : {0.0, 150.0, 300.0, 700.0}) EXPECT_EQ(curve.at(t).tension_kPa, 0) << t;
}

}  // namespace
}  // namespace cardiac
