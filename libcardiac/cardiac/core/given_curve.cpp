#include "cardiac/core/given_curve.hpp"

#include <cmath>
#include <stdexcept>

namespace cardiac {

namespace {
constexpr double kSameTime = 1e-6;  // in parts of a period
}  // namespace

GivenCurve GivenCurve::through(std::vector<double> times_ms, std::vector<double> values, double period_ms) {
  if (times_ms.size() < 2 || times_ms.size() != values.size())
    throw std::invalid_argument("given curve: fewer than two samples");
  GivenCurve out;
  out.begin_ms = times_ms.front();
  out.end_ms = times_ms.back();
  out.repeats = period_ms > 0;
  if (!out.repeats) {
    out.cubic = polyaffine::MonotoneCubic(std::move(times_ms), std::move(values));
    return out;
  }
  const double end = out.begin_ms + period_ms;
  if (out.end_ms > end + kSameTime * period_ms)
    throw std::invalid_argument("given curve: samples beyond its period");
  if (out.end_ms < end - kSameTime * period_ms) {
    times_ms.push_back(end);
    values.push_back(values.front());
  } else {
    times_ms.back() = end;
    values.back() = values.front();
  }
  // The neighbours on the other side of the joint give the curve one slope there.
  const std::size_t n = times_ms.size();
  const double before = times_ms[n - 2] - period_ms, after = times_ms[1] + period_ms;
  const double value_before = values[n - 2], value_after = values[1];
  times_ms.insert(times_ms.begin(), before);
  values.insert(values.begin(), value_before);
  times_ms.push_back(after);
  values.push_back(value_after);
  out.end_ms = end;
  out.cubic = polyaffine::MonotoneCubic(std::move(times_ms), std::move(values));
  return out;
}

std::pair<double, double> GivenCurve::at(double time_ms) const {
  if (repeats) return cubic(time_ms - period_ms() * std::floor((time_ms - begin_ms) / period_ms()));
  if (time_ms < begin_ms) return {cubic(begin_ms).first, 0};
  if (time_ms > end_ms) return {cubic(end_ms).first, 0};
  return cubic(time_ms);
}

}  // namespace cardiac
