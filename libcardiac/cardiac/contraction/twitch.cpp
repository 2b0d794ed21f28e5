#include "cardiac/contraction/twitch.hpp"

#include <algorithm>
#include <cmath>

#include <polyaffine/core/error.hpp>
#include <polyaffine/solve/ode.hpp>

namespace cardiac {

using polyaffine::Vector;

double Twitch::peak_kPa() const {
  return *std::ranges::max_element(tension_kPa);
}

Twitch moved_twitch(const SarcomereModel& model, const StretchCurve& stretch,
                    const SarcomereModel::States& start, const std::vector<double>& times_ms) {
  const int n = model.num_states();
  SarcomereModel::States z{};
  SarcomereResponse r;
  const auto respond = [&](double t, const double* state) {
    std::copy_n(state, n, z.begin());
    const auto [value, rate] = stretch(t);
    model.respond({model.drive(t), value, rate}, z, false, r);
  };
  const auto rates = [&](double t, const Vector& state, Vector& out) {
    respond(t, state.data());
    std::copy_n(r.rates.begin(), n, out.data());
  };
  // The drive may rise within a few ms from nothing, which longer steps would miss.
  constexpr double kMaxStep_ms = 0.5;
  const polyaffine::OdeSolution solution = polyaffine::solve_ode(
      rates, times_ms.front(), Eigen::Map<const Vector>(start.data(), n),
      Eigen::Map<const Vector>(times_ms.data(), std::ssize(times_ms)),
      {.relative_tolerance = 1e-8, .absolute_tolerance = 1e-10, .max_step = kMaxStep_ms});
  if (!solution.finished()) throw polyaffine::ComputationError("contraction: " + solution.message);
  Twitch out;
  out.times_ms = times_ms;
  for (Eigen::Index i = 0; i < std::ssize(times_ms); ++i) {
    respond(times_ms[static_cast<std::size_t>(i)], solution.states.col(i).data());
    out.tension_kPa.push_back(r.tension_kPa);
    out.states.push_back(z);
  }
  return out;
}

Twitch isometric_twitch(const SarcomereModel& model, double stretch, int samples) {
  constexpr int kMostBeats = 100;
  constexpr double kRepeats = 1e-6;  // of the peak
  std::vector<double> times;
  for (int i = 0; i <= samples; ++i) times.push_back(model.period_ms() * i / samples);
  SarcomereModel::States start = model.at_rest(model.drive(0), stretch);
  Twitch out;
  for (int beat = 0; beat < kMostBeats; ++beat) {
    out = moved_twitch(
        model,
        [&](double) {
          return Stretch{stretch, 0};
        },
        start, times);
    if (std::abs(out.tension_kPa.back() - out.tension_kPa.front()) <= kRepeats * out.peak_kPa()) break;
    start = out.states.back();
  }
  return out;
}

}  // namespace cardiac
