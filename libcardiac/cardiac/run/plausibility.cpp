#include "cardiac/run/plausibility.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <sstream>

namespace cardiac {
namespace {

using Texts = std::vector<std::string>;

template <class... Parts>
std::string joined(const Parts&... parts) {
  std::ostringstream out;
  out.precision(4);
  (out << ... << parts);
  return out.str();
}

bool finite(std::initializer_list<double> values) {
  return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

bool finite(const BeatResult& r) {
  // Without [cavities] there is no volume at all.
  const auto sample = [](bool of_cavity) {
    return [of_cavity](const CavitySample& s) {
      return finite({s.time_ms, s.pressure_mmHg}) && (std::isfinite(s.volume_mL) || !of_cavity);
    };
  };
  const auto strain = [](const SegmentStrain& s) {
    return finite(
        {s.longitudinal, s.circumferential, s.radial, s.shear_lc, s.shear_lr, s.shear_cr, s.volume_ratio});
  };
  const auto ventricle = [&](const VentricleSummary& v) {
    const bool of_cavity = r.has_beat || std::ranges::any_of(v.samples, [](const CavitySample& s) {
                             return std::isfinite(s.volume_mL);
                           });
    return std::ranges::all_of(v.samples, sample(of_cavity)) &&
           (!r.has_beat || finite({v.edv_mL, v.esv_mL, v.ef_percent, v.peak_pressure_mmHg, v.edp_mmHg}));
  };
  return finite({r.min_det_F, r.max_det_F, r.strain.gls_percent, r.strain.gcs_percent, r.strain.grs_percent,
                 r.strain.twist_deg}) &&
         std::ranges::all_of(r.ventricles, ventricle) &&
         std::ranges::all_of(r.instants, [&](const Instant& i) {
           for (std::size_t s = 0; s < i.strain.size(); ++s)
             if (s < r.segments.size() && r.segments[s].volume_mL > 0 && !strain(i.strain[s])) return false;
           return true;
         });
}

void check_wall(const BeatResult& r, Texts& out) {
  if (r.min_det_F < kLeastPointVolume)
    out.push_back(joined("the wall was compressed to ", 100 * r.min_det_F,
                         " % of its volume somewhere (min_det_F), expected at least ",
                         100 * kLeastPointVolume, " %"));
  for (std::size_t s = 0; s < r.segments.size(); ++s) {
    const auto beyond = std::ranges::find_if(r.instants, [s](const Instant& i) {
      const double ratio = s < i.strain.size() ? i.strain[s].volume_ratio : 1;
      return ratio < kLeastSegmentVolume || ratio > kMostSegmentVolume;
    });
    if (beyond == r.instants.end()) continue;
    out.push_back(joined("segment ", r.segments[s].number, " had ", 100 * beyond->strain[s].volume_ratio,
                         " % of its volume at ", beyond->time_ms, " ms, expected ", 100 * kLeastSegmentVolume,
                         " to ", 100 * kMostSegmentVolume, " %"));
    return;  // one segment stands for all
  }
}

void check_ventricle(const BeatResult& r, const VentricleSummary& v, Texts& out) {
  const auto least = std::ranges::min_element(v.samples, {}, &CavitySample::volume_mL);
  if (least != v.samples.end() && least->volume_mL <= 0)
    out.push_back(joined(v.name, ": the cavity had ", least->volume_mL, " mL at ", least->time_ms,
                         " ms: turned inside out"));
  if (!r.has_beat) return;
  if (v.ef_percent < kLeastEjection_percent || v.ef_percent > kMostEjection_percent)
    out.push_back(joined(v.name, ": the ejection fraction is ", v.ef_percent, " %, expected 0 to ",
                         kMostEjection_percent, " %"));
  if (v.peak_pressure_mmHg > kMostPressure_mmHg)
    out.push_back(joined(v.name, ": the peak pressure is ", v.peak_pressure_mmHg, " mmHg, expected at most ",
                         kMostPressure_mmHg, " mmHg"));
  double wall_mL = 0;
  for (const SegmentInfo& s : r.segments) wall_mL += s.volume_mL;
  if (wall_mL > 0 && v.edv_mL > kMostCavityOverWall * wall_mL)
    out.push_back(joined(v.name, ": the end-diastolic volume is ", v.edv_mL, " mL in a wall of ", wall_mL,
                         " mL, expected at most ", kMostCavityOverWall, " times the wall"));
}

}  // namespace

std::vector<std::string> absurdities(const BeatResult& r) {
  Texts out;
  if (!finite(r)) out.emplace_back("the result holds a number that is none (infinite, or undefined)");
  check_wall(r, out);
  for (const VentricleSummary& v : r.ventricles) check_ventricle(r, v, out);
  return out;
}

void refuse_absurdities(BeatResult& result, bool keep) {
  if (!result.completed) return;
  std::string reason;
  for (const std::string& text : absurdities(result)) reason += (reason.empty() ? "" : "; ") + text;
  if (reason.empty()) return;
  if (keep) return result.warnings.push_back("absurd result, kept by --force: " + reason);
  result.completed = false;
  result.stop_reason = "absurd result: " + reason;
}

}  // namespace cardiac
