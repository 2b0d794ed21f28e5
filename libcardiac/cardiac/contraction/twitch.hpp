#pragma once

#include <functional>
#include <vector>

#include <cardiac/contraction/sarcomere.hpp>

namespace cardiac {

/// Tension and states of one fibre over the time.
struct Twitch {
  std::vector<double> times_ms, tension_kPa;
  std::vector<SarcomereModel::States> states;
  double peak_kPa() const;
};

/// The stretch of a fibre and its rate (1/ms) at a time.
struct Stretch {
  double value, rate_per_ms;
};
using StretchCurve = std::function<Stretch(double time_ms)>;

/// One fibre that is moved, from states at a time on, told at `times_ms`, by CVODE (solve_ode). Throws
/// ComputationError where it stops.
Twitch moved_twitch(const SarcomereModel& model, const StretchCurve& stretch,
                    const SarcomereModel::States& start, const std::vector<double>& times_ms);

/// The twitch of a fibre that is held and excited every period, once it repeats itself (1e-6 of its peak, or
/// 100 beats), at `samples` equal times of a period and its end.
Twitch isometric_twitch(const SarcomereModel& model, double stretch, int samples);

}  // namespace cardiac
