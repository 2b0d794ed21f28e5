#include <cardiac/report/strain_curves.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include <cardiac/report/axes.hpp>
#include <cardiac/report/tables.hpp>

namespace cardiac {
namespace {

// Okabe & Ito's colours, apart for every common kind of colour blindness.
constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kTerritories{
    {{"LAD", "#d55e00"}, {"RCA", "#0072b2"}, {"LCx", "#009e73"}, {"right ventricle", "#7f7f7f"}}};
constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kLevels{
    {{"basal", ""}, {"mid", "9 4"}, {"apical", "2.5 3"}, {"apex", "11 3 2 3"}}};

size_t territory(int segment) {
  constexpr std::array<size_t, 17> kOf{0, 0, 1, 1, 2, 2, 0, 0, 1, 1, 2, 2, 0, 0, 1, 2, 0};
  return segment >= 1 && segment <= 17 ? kOf[static_cast<size_t>(segment - 1)] : 3;
}

size_t level(int segment) {
  return segment <= 6 ? 0 : segment <= 12 ? 1 : segment <= 16 ? 2 : segment == 17 ? 3 : 0;
}

std::string stroke(size_t territory_index, size_t level_index) {
  std::string style = "stroke=\"" + std::string(kTerritories[territory_index].second) +
                      "\" stroke-width=\"1.8\" stroke-linejoin=\"round\"";
  const std::string_view dashes = kLevels[level_index].second;
  if (!dashes.empty()) style += " stroke-dasharray=\"" + std::string(dashes) + "\"";
  return style;
}

struct Panel {
  std::string_view title;
  double SegmentStrain::*strain;
};
constexpr std::array<Panel, 3> kPanels{{{"Longitudinal strain", &SegmentStrain::longitudinal},
                                        {"Circumferential strain", &SegmentStrain::circumferential},
                                        {"Radial strain", &SegmentStrain::radial}}};

Axis strain_axis(const BeatResult& result, double SegmentStrain::*strain) {
  double low = 0, high = 0;
  for (const Instant& instant : result.instants) {
    for (const SegmentStrain& s : instant.strain) {
      if (!std::isfinite(s.*strain)) continue;
      low = std::min(low, 100 * s.*strain);
      high = std::max(high, 100 * s.*strain);
    }
  }
  return round_axis(low, high, 4);
}

void draw_marks(Svg& svg, const Plot& plot, const BeatResult& result) {
  if (!result.has_beat) return;
  const auto [ed_ms, es_ms] = cardiac_times(result);
  for (const auto& [time, name] : {std::pair{ed_ms, "ED"}, std::pair{es_ms, "ES"}}) {
    if (time < plot.x.low || time > plot.x.high) continue;
    const double x = plot.at(time, plot.y.low).x;
    svg.line({x, plot.top}, {x, plot.top + plot.height},
             "stroke=\"#333333\" stroke-width=\"1.1\" stroke-dasharray=\"1.5 2.5\"");
    const bool at_edge = x - plot.left < 12;
    svg.text({x + (at_edge ? 1 : 0), plot.top - 10}, name,
             {13, "#333333", at_edge ? Anchor::start : Anchor::middle, true});
  }
}

void draw_curves(Svg& svg, const Plot& plot, const BeatResult& result, double SegmentStrain::*strain) {
  for (size_t i = 0; i < result.segments.size(); ++i) {
    const SegmentInfo& segment = result.segments[i];
    std::vector<DrawPoint> points;
    for (const Instant& instant : result.instants)
      if (i < instant.strain.size() && std::isfinite(instant.strain[i].*strain))
        points.push_back(plot.at(instant.time_ms, 100 * instant.strain[i].*strain));
    svg.polyline(points, stroke(territory(segment.number), level(segment.number)),
                 std::to_string(segment.number) + " " + segment.name);
  }
}

void draw_legend(Svg& svg, double top, const BeatResult& result) {
  const bool right =
      std::ranges::any_of(result.segments, [](const auto& s) { return territory(s.number) == 3; });
  constexpr double kLeft = 78, kColumn = 148;
  for (size_t i = 0; i < kTerritories.size() - (right ? 0 : 1); ++i) {
    const double x = kLeft + kColumn * static_cast<double>(i);
    svg.line({x, top}, {x + 34, top}, stroke(i, 0));
    svg.text({x + 42, top}, kTerritories[i].first, {14, "#222222"});
  }
  for (size_t i = 0; i < kLevels.size(); ++i) {
    const double x = kLeft + kColumn * static_cast<double>(i);
    std::string style = "stroke=\"#333333\" stroke-width=\"1.8\" stroke-dasharray=\"";
    svg.line({x, top + 24}, {x + 34, top + 24}, style + std::string(kLevels[i].second) + "\"");
    svg.text({x + 42, top + 24}, kLevels[i].first, {14, "#222222"});
  }
}

}  // namespace

std::string strain_curves_svg(const BeatResult& result) {
  constexpr double kWidth = 680, kPanelHeight = 215, kPitch = 290, kTop = 56;
  Svg svg(kWidth, kTop + 3 * kPitch + 40, "Strain of each segment over the beat",
          "Three panels, longitudinal, circumferential and radial strain in percent against time in "
          "milliseconds, one curve a segment; the numbers are in strain.csv");
  const double first = result.instants.empty() ? 0 : result.instants.front().time_ms;
  const double last = result.instants.empty() ? 1 : result.instants.back().time_ms;
  for (size_t i = 0; i < kPanels.size(); ++i) {
    const double top = kTop + kPitch * static_cast<double>(i);
    const Plot plot{78,
                    top,
                    kWidth - 78 - 22,
                    kPanelHeight,
                    tight_axis(first, last, 8),
                    strain_axis(result, kPanels[i].strain)};
    plot.draw(svg, i + 1 == kPanels.size() ? "time (ms)" : "", "strain (%)", 14);
    svg.text({78, top - 34}, kPanels[i].title, {17, "#222222", Anchor::start, true});
    draw_curves(svg, plot, result, kPanels[i].strain);
    draw_marks(svg, plot, result);
  }
  draw_legend(svg, kTop + 3 * kPitch - 8, result);
  return svg.str();
}

}  // namespace cardiac
