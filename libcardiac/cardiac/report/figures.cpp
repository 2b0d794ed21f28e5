#include <cardiac/report/figures.hpp>

#include <algorithm>

#include <cardiac/report/bullseye.hpp>
#include <cardiac/report/pv_loop.hpp>
#include <cardiac/report/strain_curves.hpp>
#include <cardiac/report/tables.hpp>
#include <cardiac/strain/peaks.hpp>
#include <polyaffine/core/atomic_file.hpp>

namespace cardiac {
namespace {

bool has_strain(const BeatResult& result) {
  return !result.instants.empty() && !result.instants.front().strain.empty();
}

Bullseye peak_bullseye(const BeatResult& result, const std::vector<SegmentPeaks>& peaks,
                       StrainPeak SegmentPeaks::*strain, const std::string& title) {
  const bool radial = strain == &SegmentPeaks::radial;
  Bullseye bullseye{title,
                    "%",
                    ColourScale::diverging,
                    radial ? "thinning" : "shortening",
                    radial ? "thickening" : "lengthening",
                    1,
                    {}};
  for (size_t i = 0; i < peaks.size(); ++i) {
    const int number = result.segments.at(i).number;
    if (number >= 1 && number <= 17)
      bullseye.values[static_cast<size_t>(number - 1)] = 100 * (peaks[i].*strain).value;
  }
  return bullseye;
}

Bullseye activation_bullseye(const BeatResult& result) {
  Bullseye bullseye{"Activation time", "ms", ColourScale::sequential, "early", "late", 0, {}};
  for (const SegmentInfo& s : result.segments)
    if (s.number >= 1 && s.number <= 17) bullseye.values[static_cast<size_t>(s.number - 1)] = s.activation_ms;
  return bullseye;
}

}  // namespace

std::vector<Figure> bullseye_figures(const BeatResult& result) {
  std::vector<Figure> list;
  if (has_strain(result)) {
    const auto [ed_ms, es_ms] = cardiac_times(result);
    const std::vector<SegmentPeaks> peaks = strain_peaks(result.instants, ed_ms, es_ms);
    const auto add = [&](const std::string& name, StrainPeak SegmentPeaks::*strain) {
      list.push_back({"bullseye_" + name + ".svg",
                      bullseye_svg(peak_bullseye(result, peaks, strain, "Peak " + name + " strain"))});
    };
    add("longitudinal", &SegmentPeaks::longitudinal);
    add("circumferential", &SegmentPeaks::circumferential);
    add("radial", &SegmentPeaks::radial);
  }
  if (std::ranges::any_of(result.segments, [](const SegmentInfo& s) { return s.activation_ms.has_value(); }))
    list.push_back({"bullseye_activation.svg", bullseye_svg(activation_bullseye(result))});
  return list;
}

std::vector<Figure> figures(const BeatResult& result) {
  std::vector<Figure> list = bullseye_figures(result);
  if (has_strain(result)) list.push_back({"strain_curves.svg", strain_curves_svg(result)});
  if (std::ranges::any_of(result.ventricles, [](const VentricleSummary& v) { return !v.samples.empty(); }))
    list.push_back({"pv_loop.svg", pv_loop_svg(result)});
  return list;
}

void write_figures(const BeatResult& result, const std::filesystem::path& out) {
  polyaffine::make_folder(out);
  const std::vector<Figure> list = figures(result);
  for (const Figure& figure : list) polyaffine::write_atomically(out / figure.file, figure.svg);
  for (const char* name : {"bullseye_longitudinal.svg", "bullseye_circumferential.svg", "bullseye_radial.svg",
                           "bullseye_activation.svg", "strain_curves.svg", "pv_loop.svg"}) {
    std::error_code ignored;
    if (std::ranges::find(list, name, &Figure::file) == list.end())
      std::filesystem::remove(out / name, ignored);
  }
}

}  // namespace cardiac
