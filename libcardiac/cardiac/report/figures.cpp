#include <cardiac/report/figures.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include <cardiac/report/bullseye.hpp>
#include <cardiac/report/filling.hpp>
#include <cardiac/report/protocol_facts.hpp>
#include <cardiac/report/pv_loop.hpp>
#include <cardiac/report/strain_curves.hpp>
#include <cardiac/report/tables.hpp>
#include <cardiac/report/text.hpp>
#include <cardiac/report/time_curves.hpp>
#include <cardiac/strain/peaks.hpp>
#include <polyaffine/core/atomic_file.hpp>

namespace cardiac {
namespace {

struct NormalStrain {
  std::string name;
  Quantity quantity;
  StrainPeak SegmentPeaks::*strain;
};
const std::array<NormalStrain, 3> kStrains{
    {{"longitudinal", Quantity::longitudinal, &SegmentPeaks::longitudinal},
     {"circumferential", Quantity::circumferential, &SegmentPeaks::circumferential},
     {"radial", Quantity::radial, &SegmentPeaks::radial}}};

bool has_strain(const BeatResult& result) {
  return !result.instants.empty() && !result.instants.front().strain.empty();
}

bool has_right_wall(const BeatResult& result) {
  return std::ranges::any_of(result.segments, [](const SegmentInfo& s) { return s.number >= 18; });
}

std::map<int, double> values_of(const BeatResult& result, const std::vector<SegmentPeaks>& peaks,
                                StrainPeak SegmentPeaks::*strain, double StrainPeak::*value) {
  std::map<int, double> values;
  for (size_t i = 0; i < peaks.size(); ++i)
    values[result.segments.at(i).number] = 100 * (peaks[i].*strain).*value;
  return values;
}

Bullseye activation_bullseye(const BeatResult& result, const ActivationSpan& span,
                             const std::vector<NamedRegion>& regions) {
  Bullseye bullseye{"Activation time",
                    "after the first segment, at " + display_text(span.first_ms, 0) + " ms",
                    Quantity::activation,
                    {},
                    regions};
  for (const SegmentInfo& s : result.segments)
    if (s.activation_ms) bullseye.values[s.number] = *s.activation_ms - span.first_ms;
  return bullseye;
}

std::vector<Figure> strain_bullseyes(const BeatResult& result, const std::vector<NamedRegion>& regions) {
  const auto [ed_ms, es_ms] = cardiac_times(result);
  const std::vector<SegmentPeaks> peaks = strain_peaks(result.instants, ed_ms, es_ms);
  const bool beat = has_systole(result);
  const std::string note = beat ? "against end diastole" : "at the end, against the start";
  std::vector<Figure> list;
  const auto add = [&](const std::string& file, const std::string& title, const std::string& under,
                       const NormalStrain& s, double StrainPeak::*value, bool right) {
    const Bullseye bullseye{title, under, s.quantity, values_of(result, peaks, s.strain, value), regions};
    list.push_back(
        {"bullseye_" + file + s.name + ".svg", right ? right_wall_svg(bullseye) : bullseye_svg(bullseye)});
  };
  for (const NormalStrain& s : kStrains)
    add("", (beat ? "End-systolic " : "Final ") + s.name + " strain", note, s, &StrainPeak::end_systolic,
        false);
  if (has_right_wall(result))
    for (const NormalStrain& s : kStrains)
      add("right_", (beat ? "End-systolic " : "Final ") + s.name + " strain", "right free wall, " + note, s,
          &StrainPeak::end_systolic, true);
  if (beat)
    for (const NormalStrain& s : kStrains)
      add("peak_", "Peak " + s.name + " strain", "at any time of the beat, also after systole", s,
          &StrainPeak::value, false);
  return list;
}

/// Every name that figures() may give.
std::vector<std::string> figure_names() {
  std::vector<std::string> names{"bullseye_activation.svg", "strain_curves.svg", "strain_curves_right.svg",
                                 "time_curves.svg",         "pv_loop.svg",       "filling.svg"};
  for (const NormalStrain& s : kStrains)
    for (const char* of : {"", "peak_", "right_"})
      names.push_back(std::string("bullseye_") + of + s.name + ".svg");
  return names;
}

}  // namespace

std::optional<ActivationSpan> activation_span(const BeatResult& result) {
  std::optional<ActivationSpan> span;
  for (const SegmentInfo& s : result.segments) {
    if (!s.activation_ms || !std::isfinite(*s.activation_ms)) continue;
    if (!span) span = ActivationSpan{*s.activation_ms, *s.activation_ms};
    span->first_ms = std::min(span->first_ms, *s.activation_ms);
    span->last_ms = std::max(span->last_ms, *s.activation_ms);
  }
  return span;
}

std::vector<Figure> bullseye_figures(const BeatResult& result, const RunInfo& info) {
  const std::vector<NamedRegion> regions = regions_of(info.protocol_json);
  std::vector<Figure> list;
  if (has_strain(result)) list = strain_bullseyes(result, regions);
  if (const auto span = activation_span(result); span && !span->uniform())
    list.push_back({"bullseye_activation.svg", bullseye_svg(activation_bullseye(result, *span, regions))});
  return list;
}

std::vector<Figure> figures(const BeatResult& result, const RunInfo& info) {
  std::vector<Figure> list = bullseye_figures(result, info);
  if (has_strain(result)) {
    list.push_back({"strain_curves.svg", strain_curves_svg(result)});
    if (has_right_wall(result)) list.push_back({"strain_curves_right.svg", right_strain_curves_svg(result)});
  }
  if (std::ranges::any_of(result.ventricles, [](const VentricleSummary& v) { return !v.samples.empty(); })) {
    list.push_back({"time_curves.svg", time_curves_svg(result)});
    list.push_back({"pv_loop.svg", pv_loop_svg(result)});
  }
  if (result.unloading) list.push_back({"filling.svg", filling_svg(*result.unloading)});
  return list;
}

void write_figures(const BeatResult& result, const RunInfo& info, const std::filesystem::path& out) {
  polyaffine::make_folder(out);
  const std::vector<Figure> list = figures(result, info);
  for (const Figure& figure : list) polyaffine::write_atomically(out / figure.file, figure.svg);
  for (const std::string& name : figure_names()) {
    std::error_code ignored;
    if (std::ranges::find(list, name, &Figure::file) == list.end())
      std::filesystem::remove(out / name, ignored);
  }
}

}  // namespace cardiac
