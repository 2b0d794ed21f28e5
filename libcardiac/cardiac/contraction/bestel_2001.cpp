#include "cardiac/contraction/bestel_2001.hpp"

#include <algorithm>
#include <cmath>
#include <polyaffine/core/error.hpp>
#include <polyaffine/solve/ode.hpp>
#include <sstream>

namespace cardiac {
namespace {

using polyaffine::InputError;

double smooth_step(double x) {
  return 0.5 * (1 + std::tanh(x));
}

double wrapped(double time, double period) {
  return time - period * std::floor(time / period);
}

void require_positive(double value, const char* name, const char* unit) {
  if (value > 0 && std::isfinite(value)) return;
  std::ostringstream text;
  text << "contraction: " << name << " is " << value << ", expected a positive number in " << unit;
  throw InputError(text.str());
}

/// The time between `relaxing` (a < 0) and `contracting` (a > 0) where a = 0, by bisection to the last bit.
double zero_of_activation(const BestelParameters& p, double period_ms, double relaxing, double contracting) {
  for (;;) {
    const double middle = 0.5 * (relaxing + contracting);
    if (middle == relaxing || middle == contracting) return middle;
    (activation_rate(p, period_ms, middle) > 0 ? contracting : relaxing) = middle;
  }
}

std::vector<TensionCurve::Sample> integrate(const BestelParameters& p, double period_ms, double begin,
                                            double spacing, int intervals, double initial_tension) {
  const auto rate = [&](double time, const Vector& tension, Vector& slope) {
    slope[0] = tension_rate(p, period_ms, time, tension[0]);
  };
  const Vector times = Vector::LinSpaced(intervals + 1, begin, begin + spacing * intervals);
  const polyaffine::OdeSolution solution =
      polyaffine::solve_ode(rate, begin, Vector::Constant(1, initial_tension), times,
                            {.relative_tolerance = 1e-10,
                             .absolute_tolerance = 1e-12 * std::max(p.contractility_kPa, 1.0),
                             .max_step = p.steepness_ms});
  if (!solution.finished()) throw polyaffine::ComputationError("contraction: " + solution.message);

  std::vector<TensionCurve::Sample> nodes(times.size());
  for (Eigen::Index i = 0; i < times.size(); ++i) {
    const double tension = solution.states(0, i);
    nodes[i] = {tension, tension_rate(p, period_ms, times[i], tension)};
  }
  return nodes;
}

}  // namespace

void check_contraction(const BestelParameters& p, double period_ms) {
  require_positive(p.activation_rate_per_ms, "activation rate", "1/ms");
  require_positive(p.relaxation_rate_per_ms, "relaxation rate", "1/ms");
  require_positive(p.steepness_ms, "steepness", "ms");
  require_positive(period_ms, "heart period", "ms");
  std::ostringstream text;
  if (!(p.contractility_kPa >= 0 && std::isfinite(p.contractility_kPa))) {
    text << "contraction: contractility is " << p.contractility_kPa
         << ", expected a number of at least 0 in kPa";
    throw InputError(text.str());
  }
  if (!(p.diastole_ms > p.systole_ms && p.diastole_ms < p.systole_ms + period_ms)) {
    text << "contraction: relaxation begins at " << p.diastole_ms << " ms, expected after contraction ("
         << p.systole_ms << " ms) and less than one heart period (" << period_ms << " ms) later";
    throw InputError(text.str());
  }
  const double middle = 0.5 * (p.systole_ms + p.diastole_ms);
  if (!(activation_rate(p, period_ms, middle) > 0)) {
    text << "contraction: from " << p.systole_ms << " to " << p.diastole_ms
         << " ms is too short to contract with a steepness of " << p.steepness_ms << " ms";
    throw InputError(text.str());
  }
  if (!(activation_rate(p, period_ms, middle + 0.5 * period_ms) < 0)) {
    text << "contraction: a heart period of " << period_ms << " ms leaves no time to relax between "
         << p.diastole_ms << " ms and the next contraction at " << p.systole_ms + period_ms << " ms";
    throw InputError(text.str());
  }
}

double contraction_indicator(const BestelParameters& p, double period_ms, double time_ms) {
  const double middle = 0.5 * (p.systole_ms + p.diastole_ms), half = 0.5 * (p.diastole_ms - p.systole_ms);
  const double offset = std::remainder(time_ms - middle, period_ms);
  double sum = 0;  // a beat and its neighbours; those further away are below the last bit
  for (const double t : {offset - period_ms, offset, offset + period_ms}) {
    sum += smooth_step((t + half) / p.steepness_ms) * smooth_step((half - t) / p.steepness_ms);
  }
  return sum;
}

double activation_rate(const BestelParameters& p, double period_ms, double time_ms) {
  const double f = contraction_indicator(p, period_ms, time_ms);
  return p.activation_rate_per_ms * f - p.relaxation_rate_per_ms * (1 - f);
}

double tension_rate(const BestelParameters& p, double period_ms, double time_ms, double tension_kPa) {
  const double a = activation_rate(p, period_ms, time_ms);
  return -std::abs(a) * tension_kPa + p.contractility_kPa * std::max(a, 0.0);
}

TensionCurve::TensionCurve(const BestelParameters& p, double period_ms) : period_ms_(period_ms) {
  check_contraction(p, period_ms);
  const double middle = 0.5 * (p.systole_ms + p.diastole_ms);
  begin_ms_ = zero_of_activation(p, period_ms, middle - 0.5 * period_ms, middle);
  end_ms_ = zero_of_activation(p, period_ms, middle + 0.5 * period_ms, middle);

  const double wanted_spacing = p.steepness_ms / 20;
  const auto intervals = [&](double length) { return static_cast<int>(std::ceil(length / wanted_spacing)); };
  const int contracting = intervals(end_ms_ - begin_ms_),
            relaxing = intervals(begin_ms_ + period_ms - end_ms_);
  contraction_.spacing_ms = (end_ms_ - begin_ms_) / contracting;
  relaxation_.spacing_ms = (begin_ms_ + period_ms - end_ms_) / relaxing;

  double initial_tension = 0;
  for (int beat = 0;; ++beat) {
    contraction_.nodes =
        integrate(p, period_ms, begin_ms_, contraction_.spacing_ms, contracting, initial_tension);
    peak_tension_kPa_ = contraction_.nodes.back().tension_kPa;
    relaxation_.nodes = integrate(p, period_ms, end_ms_, relaxation_.spacing_ms, relaxing, peak_tension_kPa_);
    const double change = relaxation_.nodes.back().tension_kPa - initial_tension;
    initial_tension += change;
    if (std::abs(change) <= 1e-10 * p.contractility_kPa) return;
    if (beat == 100) throw polyaffine::ComputationError("contraction: no periodic tension within 100 beats");
  }
}

TensionCurve::TensionCurve(const GivenCurve& given) : period_ms_(given.period_ms()) {
  constexpr double kOnset = 0.01;          // of the range
  constexpr int kSamples = 2000;           // of a period, where onset and peak are looked for
  constexpr double kWanted_spacing = 0.5;  // ms
  const auto sample = [&](int i) { return given.begin_ms + period_ms_ * i / kSamples; };
  double low = given.at(given.begin_ms).first, high = low;
  int top = 0;
  for (int i = 1; i < kSamples; ++i) {
    const double tension = given.at(sample(i)).first;
    low = std::min(low, tension);
    if (tension > high) {
      high = tension;
      top = i;
    }
  }
  if (!(high > low)) {
    std::ostringstream text;
    text << "contraction: the tension that is given is " << high
         << " kPa at all times, expected one that rises";
    throw InputError(text.str());
  }
  int onset = top - 1;
  while (onset > top - kSamples && given.at(sample(onset)).first > low + kOnset * (high - low)) --onset;
  peak_tension_kPa_ = high;
  begin_ms_ = sample(onset);
  end_ms_ = sample(top);
  const auto fill = [&](Piece& piece, double from, double to) {
    const int intervals = std::max(1, static_cast<int>(std::ceil((to - from) / kWanted_spacing)));
    piece.spacing_ms = (to - from) / intervals;
    for (int i = 0; i <= intervals; ++i) {
      const double t = from + piece.spacing_ms * i;
      const auto [tension, rate] =
          given.at(given.repeats ? t : wrapped(t - given.begin_ms, period_ms_) + given.begin_ms);
      piece.nodes.push_back({tension, rate});
    }
  };
  fill(contraction_, begin_ms_, end_ms_);
  fill(relaxation_, end_ms_, begin_ms_ + period_ms_);
}

TensionCurve::Sample TensionCurve::at(double time_ms) const {
  const double from_begin = wrapped(time_ms - begin_ms_, period_ms_), length = end_ms_ - begin_ms_;
  const Piece& piece = from_begin < length ? contraction_ : relaxation_;
  const double position = (from_begin < length ? from_begin : from_begin - length) / piece.spacing_ms;
  const auto index = std::min(static_cast<std::size_t>(position), piece.nodes.size() - 2);
  const double s = position - static_cast<double>(index), h = piece.spacing_ms;
  const auto [v0, d0] = piece.nodes[index];
  const auto [v1, d1] = piece.nodes[index + 1];
  const double step = v1 - v0, c = 3 * step - h * (2 * d0 + d1), d = h * (d0 + d1) - 2 * step;
  return {v0 + s * (h * d0 + s * (c + s * d)), d0 + s * (2 * c + 3 * d * s) / h};
}

void TensionCurve::evaluate(double time_ms, const Vector& delay_ms, const Vector& scale,
                            Eigen::Ref<Vector> tension_kPa, Eigen::Ref<Vector> rate_kPa_per_ms) const {
  for (Eigen::Index i = 0; i < delay_ms.size(); ++i) {
    const Sample sample = at(time_ms - delay_ms[i]);
    tension_kPa[i] = scale[i] * sample.tension_kPa;
    rate_kPa_per_ms[i] = scale[i] * sample.rate_kPa_per_ms;
  }
}

}  // namespace cardiac
