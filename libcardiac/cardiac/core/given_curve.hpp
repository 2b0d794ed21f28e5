#pragma once

#include <string>
#include <utility>
#include <vector>

#include <polyaffine/core/monotone_cubic.hpp>

namespace cardiac {

/// A value over the time that somebody measured: once continuously differentiable through its samples
/// (polyaffine::MonotoneCubic), constant before the first and behind the last one, or repeated for ever.
struct GivenCurve {
  polyaffine::MonotoneCubic cubic;
  double begin_ms = 0, end_ms = 0;
  bool repeats = false;

  /// Through samples at ascending times. One that repeats after `period_ms` may hold its first value again at
  /// the end. Throws std::invalid_argument with fewer than two samples, times that do not ascend or samples
  /// beyond the period.
  static GivenCurve through(std::vector<double> times_ms, std::vector<double> values, double period_ms = 0);

  /// Value and rate (per ms) at any time.
  std::pair<double, double> at(double time_ms) const;
  double period_ms() const { return end_ms - begin_ms; }
};

/// Pressures (kPa) or volumes (mm³) of the cavities over the time, the left ventricle's first.
struct GivenCavities {
  bool are_volumes = false;
  std::vector<GivenCurve> curves;
};

}  // namespace cardiac
