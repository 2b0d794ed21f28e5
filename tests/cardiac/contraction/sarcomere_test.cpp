#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

#include <cardiac/contraction/bestel_full_2001.hpp>
#include <cardiac/contraction/land_2017.hpp>
#include <cardiac/contraction/twitch.hpp>
#include <polyaffine/core/error.hpp>

namespace cardiac {
namespace {

using States = SarcomereModel::States;

constexpr double kPeriod = 800;

BestelParameters contraction() {
  BestelParameters p;
  p.contractility_kPa = 65;
  p.systole_ms = 0;
  p.diastole_ms = 324;
  return p;
}

std::vector<double> every(double step, double end) {
  std::vector<double> out;
  for (double t = 0; t <= end + 1e-9; t += step) out.push_back(t);
  return out;
}

// The equations of Land et al. 2017 written down anew, for its supplement's variables, by Runge–Kutta's
// method of fourth order with steps of 0.01 ms.
struct IndependentLand {
  double CaTRPN = 0, TmBlocked = 1, XW = 0, XS = 0, ZETAW = 0, ZETAS = 0;

  using Array = std::array<double, 6>;
  static Array rates(const Array& y, double Ca, double lambda, double dlambda) {
    const double rs = 0.25, rw = 0.5, kuw = 0.182, kws = 0.012, phi = 2.23, nTm = 5;
    const double XU = (1 - y[1]) - y[2] - y[3];
    const double xb_ws = kws * y[2], xb_uw = kuw * XU;
    const double xb_wu = kuw * (1 / rw - 1) * y[2] - kws * y[2];
    const double xb_su = kws * rw * (1 / rs - 1) * y[3];
    double gamma = 0;
    if (y[5] > 0) gamma = 0.0085 * y[5];
    if (y[5] < -1) gamma = 0.0085 * (-y[5] - 1);
    const double Ca50 = 0.805 - 2.4 * (std::min(1.2, lambda) - 1);
    const double kb = 1 * std::pow(0.35, nTm) / (1 - rs - (1 - rs) * rw);
    const double Aeff = 25 * rs / ((1 - rs) * rw + rs);
    const double cw = phi * kuw * ((1 - rs) * (1 - rw)) / ((1 - rs) * rw);
    const double cs = phi * kws * ((1 - rs) * rw) / rs;
    return {0.1 * (Ca / Ca50 * (Ca / Ca50) * (1 - y[0]) - y[0]),
            kb * std::min(100.0, std::pow(y[0], -nTm / 2)) * XU - 1 * std::pow(y[0], nTm / 2) * y[1],
            xb_uw - xb_wu - xb_ws - 0.615 * std::abs(y[4]) * y[2],
            xb_ws - xb_su - gamma * y[3],
            Aeff * dlambda - cw * y[4],
            Aeff * dlambda - cs * y[5]};
  }
  static double tension(const Array& y, double lambda) {
    const double l = std::min(1.2, lambda);
    const double h = std::max(0.0, 1 + 2.3 * (l + std::min(0.87, l) - 1.87));
    return h * 120 / 0.25 * (y[3] * (y[5] + 1) + y[2] * y[4]);
  }
};

// Tension at whole ms of a fibre from the states y.
std::vector<double> independent_twitch(IndependentLand::Array y, const CalciumTransient& calcium,
                                       const StretchCurve& stretch, int end_ms) {
  constexpr int kParts = 100;
  const double h = 1.0 / kParts;
  const auto f = [&](double t, const IndependentLand::Array& at) {
    return IndependentLand::rates(at, calcium.at(t), stretch(t).value, stretch(t).rate_per_ms);
  };
  const auto moved = [](const IndependentLand::Array& from, const IndependentLand::Array& by, double length) {
    IndependentLand::Array out;
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = from[i] + length * by[i];
    return out;
  };
  std::vector<double> out{IndependentLand::tension(y, stretch(0).value)};
  for (int n = 0; n < end_ms * kParts; ++n) {
    const double t = n * h;
    const auto k1 = f(t, y), k2 = f(t + h / 2, moved(y, k1, h / 2)), k3 = f(t + h / 2, moved(y, k2, h / 2)),
               k4 = f(t + h, moved(y, k3, h));
    for (std::size_t i = 0; i < y.size(); ++i) y[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
    if ((n + 1) % kParts == 0) out.push_back(IndependentLand::tension(y, stretch((n + 1) * h).value));
  }
  return out;
}

// Twitches of the model and of the equations written anew agree to `tolerance` of the peak. CVODE works to
// 1e-8 of states; where their equations have corners (ζ_s = 0, −1) it loses some digits.
void expect_same_twitch(const StretchCurve& stretch, int end_ms, double tolerance) {
  const Land2017 model({});
  const States start = model.at_rest(model.drive(0), stretch(0).value);
  const Twitch twitch = moved_twitch(model, stretch, start, every(1, end_ms));
  const auto expected = independent_twitch(start, CalciumTransient(), stretch, end_ms);
  ASSERT_EQ(twitch.tension_kPa.size(), expected.size());
  double off = 0;
  for (std::size_t i = 0; i < expected.size(); ++i)
    off = std::max(off, std::abs(twitch.tension_kPa[i] - expected[i]));
  EXPECT_LT(off, tolerance * twitch.peak_kPa());
  EXPECT_GT(twitch.peak_kPa(), 20);
}

TEST(Land2017, SaturatingCalciumGivesThePublishedTension) {
  const Land2017 model({});
  // 100 µM: all troponin is bound but for 6e-5; the rest is tropomyosin that still blocks.
  EXPECT_NEAR(resting_tension(model, 100, 1).tension_kPa, 119.4, 0.05);
  // Half of troponin at 0.805 µM; steep cooperativity makes of half less than an eighth of the tension.
  EXPECT_NEAR(model.at_rest(0.805, 1)[0], 0.5, 1e-12);
}

TEST(Land2017, AnIsometricTwitchIsThatOfTheEquations) {
  for (const double stretch : {0.9, 1.0, 1.15})
    expect_same_twitch([&](double) { return Stretch{stretch, 0}; }, 600, 2e-6);
}

// Let go in relaxation by 5 % within 5 ms, then held: the tension falls at once.
TEST(Land2017, AQuickReleaseIsThatOfTheEquations) {
  const StretchCurve release = [](double t) {
    const double s = (t - 150) / 5;
    if (s <= 0) return Stretch{1, 0};
    if (s >= 1) return Stretch{0.95, 0};
    return Stretch{1 - 0.05 * s * s * (3 - 2 * s), -0.05 * 6 * s * (1 - s) / 5};
  };
  expect_same_twitch(release, 400, 2e-5);
  const Land2017 model({});
  const Twitch t = moved_twitch(model, release, model.at_rest(model.drive(0), 1), every(1, 400));
  EXPECT_LT(t.tension_kPa[156], 0.5 * t.tension_kPa[150]);
}

TEST(Sarcomere, LengthRaisesAndShorteningLowersTheTension) {
  const Land2017 land({});
  const BestelFull2001 bestel(contraction(), {}, kPeriod);
  for (const SarcomereModel* model :
       {static_cast<const SarcomereModel*>(&land), static_cast<const SarcomereModel*>(&bestel)}) {
    const Twitch held = isometric_twitch(*model, 1, 400), longer = isometric_twitch(*model, 1.1, 400);
    EXPECT_GT(longer.peak_kPa(), 1.15 * held.peak_kPa());
    const auto start = held.states.front();
    const Twitch shortening = moved_twitch(
        *model,
        [](double t) {
          return Stretch{1 - 5e-4 * t, -5e-4};
        },
        start, every(1, 200));
    EXPECT_LT(shortening.tension_kPa.back(), 0.7 * held.peak_kPa());
  }
}

// Held, without overlap and with a series spring of 1e7 kPa, cross-bridges do not move but by τ/k_s: the
// tension is that of the simplified equation.
TEST(BestelFull2001, HeldItIsTheSimplifiedModel) {
  const BestelFull2001 full(contraction(), {.series_stiffness_kPa = 1e7, .overlap_slope = 0}, kPeriod);
  const TensionCurve simplified(contraction(), kPeriod);
  const Twitch twitch = isometric_twitch(full, 1.05, 800);
  for (std::size_t i = 0; i < twitch.times_ms.size(); i += 20)
    EXPECT_NEAR(twitch.tension_kPa[i], simplified.at(twitch.times_ms[i]).tension_kPa, 0.01) << i;
  EXPECT_NEAR(twitch.peak_kPa(), 52, 2);
}

// While it shortens at a constant rate v and a = α_act, τ_c and k_c settle where their rates vanish:
//   k_c = n₀ k₀ a/(a + α v),  τ_c = (n₀ σ₀ a − k_c v)/(a + α v),  T = τ_c − µ v.
TEST(BestelFull2001, AConstantRateHasItsSteadyTension) {
  BestelParameters p = contraction();
  p.diastole_ms = 790;
  p.activation_rate_per_ms = 0.05;
  const BridgeParameters b{.overlap_slope = 0};
  const BestelFull2001 model(p, b, kPeriod);
  const double v = 1e-3, a = 0.05, loss = a + b.rate_destruction * v;
  const double k = b.bridge_stiffness_kPa * a / loss;
  const double expected = (p.contractility_kPa * a - k * v) / loss - b.viscosity_kPa_ms * v;
  const Twitch twitch = moved_twitch(
      model,
      [&](double t) {
        return Stretch{1.2 - v * t, -v};
      },
      {}, every(10, 400));
  // The transient has decayed by e^(−400 · 0.062).
  EXPECT_NEAR(twitch.tension_kPa.back(), expected, 1e-4 * expected);
}

class Derivatives : public ::testing::TestWithParam<int> {};

// Central differences at random states, away from the corners of |ζ|, |ė_c| and the overlap.
TEST_P(Derivatives, AreThoseOfDifferences) {
  const Land2017 land({});
  const BestelFull2001 bestel(contraction(), {}, kPeriod);
  const SarcomereModel& model =
      GetParam() == 0 ? static_cast<const SarcomereModel&>(land) : static_cast<const SarcomereModel&>(bestel);
  std::mt19937 random(7);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const int n = model.num_states();
  constexpr double kStep = 1e-6;
  for (int sample = 0; sample < 20; ++sample) {
    FibreMotion at{GetParam() == 0 ? uniform(0.2, 1) : uniform(0.002, 0.005), uniform(0.9, 1.15),
                   uniform(-1e-3, 1e-3)};
    if (std::abs(at.stretch - 0.87) < 0.01) at.stretch = 0.95;
    States z{};
    for (int i = 0; i < n; ++i) z[static_cast<std::size_t>(i)] = uniform(0.1, 0.3);
    SarcomereResponse r, low, high;
    model.respond(at, z, true, r);
    double size = 0;
    const auto expect = [&](double by, double plus, double minus, double step) {
      const double difference = (plus - minus) / (2 * step);
      EXPECT_NEAR(by, difference, 2e-6 * (std::abs(by) + 10)) << sample;
      size += std::abs(by);
    };
    const auto compare = [&](double step, double tension_by, const auto& rate_by) {
      expect(tension_by, high.tension_kPa, low.tension_kPa, step);
      for (int i = 0; i < n; ++i)
        expect(rate_by(i), high.rates[static_cast<std::size_t>(i)], low.rates[static_cast<std::size_t>(i)],
               step);
    };
    for (int j = 0; j < n; ++j) {
      States plus = z, minus = z;
      plus[static_cast<std::size_t>(j)] += kStep;
      minus[static_cast<std::size_t>(j)] -= kStep;
      model.respond(at, plus, false, high);
      model.respond(at, minus, false, low);
      compare(kStep, r.by_state[static_cast<std::size_t>(j)], [&](int i) {
        return r.rates_by_state[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
      });
    }
    const auto moved = [&](double stretch, double rate, SarcomereResponse& out) {
      model.respond({at.drive, at.stretch + stretch, at.rate_per_ms + rate}, z, false, out);
    };
    moved(kStep, 0, high);
    moved(-kStep, 0, low);
    compare(kStep, r.by_stretch, [&](int i) { return r.rates_by_stretch[static_cast<std::size_t>(i)]; });
    moved(0, kStep, high);
    moved(0, -kStep, low);
    compare(kStep, 0, [&](int i) { return r.rates_by_rate[static_cast<std::size_t>(i)]; });
    EXPECT_GT(size, 10);
  }
}

INSTANTIATE_TEST_SUITE_P(Models, Derivatives, ::testing::Values(0, 1));

TEST(Sarcomere, RestingTensionHasItsDerivative) {
  const Land2017 model({});
  constexpr double kStep = 1e-5;
  for (const double stretch : {0.85, 0.95, 1.1}) {
    const double difference = (resting_tension(model, 0.6, stretch + kStep).tension_kPa -
                               resting_tension(model, 0.6, stretch - kStep).tension_kPa) /
                              (2 * kStep);
    EXPECT_NEAR(resting_tension(model, 0.6, stretch).by_stretch, difference, 1e-5 * difference);
    EXPECT_GT(difference, 100);
  }
}

TEST(Calcium, PeaksWhereItIsSaidAndAddsUpAtFastRates) {
  CalciumTransient calcium{.period_ms = 5000};
  double peak = 0;
  for (double t = 0; t < 300; t += 0.1) peak = std::max(peak, calcium.at(t));
  EXPECT_NEAR(peak, 0.9, 1e-5);
  EXPECT_NEAR(calcium.at(4999), 0.1, 1e-12);
  EXPECT_NEAR(calcium.at(-1), calcium.at(4999), 1e-12);
  calcium.period_ms = 100;
  EXPECT_GT(calcium.at(0), 0.2);
  EXPECT_NEAR(calcium.at(0), calcium.at(100 - 1e-9), 1e-6);
}

}  // namespace
}  // namespace cardiac
