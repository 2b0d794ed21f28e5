#include <cardiac/strain/peaks.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace cardiac {
namespace {

constexpr double kResolution = 1e-3;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

struct Sample {
  double time_ms, strain;
};

struct Systole {
  double ed_ms, es_ms;
  bool contains(double t) const {
    return ed_ms <= es_ms ? ed_ms <= t && t <= es_ms : t >= ed_ms || t <= es_ms;
  }
};

/// The sample that `sign`·strain is largest at, or the strongest opposite one where that stays within the
/// resolution.
Sample peak_of(const std::vector<Sample>& curve, double sign) {
  if (curve.empty()) return {kNone, kNone};
  const auto [low, high] = std::ranges::minmax_element(
      curve, [sign](double a, double b) { return sign * a < sign * b; }, &Sample::strain);
  // minmax_element gives the last of equal largest values; the earliest is wanted.
  const auto first_high = std::ranges::find(curve, high->strain, &Sample::strain);
  const double wanted = sign * first_high->strain, opposite = -sign * low->strain;
  return wanted > kResolution || wanted >= opposite ? *first_high : *low;
}

double value_at(const std::vector<Sample>& curve, double t) {
  if (curve.empty()) return kNone;
  const auto after = std::ranges::lower_bound(curve, t, {}, &Sample::time_ms);
  if (after == curve.begin()) return after->strain;
  if (after == curve.end()) return curve.back().strain;
  const Sample& before = *(after - 1);
  const double s = (t - before.time_ms) / (after->time_ms - before.time_ms);
  return (1 - s) * before.strain + s * after->strain;
}

double post_systolic_index(double peak, double end_systolic, bool post_systolic) {
  if (!std::isfinite(peak) || peak * end_systolic < 0) return kNone;
  if (!post_systolic) return 0;
  if (std::abs(end_systolic) < kLeastEndSystolicStrain) return kNone;
  return 100 * (peak - end_systolic) / peak;
}

StrainPeak peak_of_strain(const std::vector<Instant>& instants, size_t segment, double SegmentStrain::*strain,
                          double sign, const Systole& systole) {
  std::vector<Sample> curve, systolic;
  for (const Instant& instant : instants) {
    const double value = instant.strain[segment].*strain;
    if (!std::isfinite(value)) continue;
    curve.push_back({instant.time_ms, value});
    if (systole.contains(instant.time_ms)) systolic.push_back(curve.back());
  }
  const double end_systolic = value_at(curve, systole.es_ms);
  if (!curve.empty()) systolic.push_back({systole.es_ms, end_systolic});
  const Sample peak = peak_of(curve, sign);
  const bool post_systolic = sign * peak.strain > 0 && !systole.contains(peak.time_ms);
  return {peak.strain, peak.time_ms, peak_of(systolic, sign).strain, end_systolic,
          post_systolic_index(peak.strain, end_systolic, post_systolic)};
}

}  // namespace

std::vector<SegmentPeaks> strain_peaks(const std::vector<Instant>& instants, double ed_time_ms,
                                       double es_time_ms) {
  const Systole systole{ed_time_ms, es_time_ms};
  std::vector<SegmentPeaks> peaks(instants.empty() ? 0 : instants.front().strain.size());
  for (size_t i = 0; i < peaks.size(); ++i) {
    peaks[i] = {peak_of_strain(instants, i, &SegmentStrain::longitudinal, -1, systole),
                peak_of_strain(instants, i, &SegmentStrain::circumferential, -1, systole),
                peak_of_strain(instants, i, &SegmentStrain::radial, +1, systole)};
  }
  return peaks;
}

}  // namespace cardiac
