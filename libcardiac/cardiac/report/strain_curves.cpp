#include <cardiac/report/strain_curves.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include <cardiac/report/axes.hpp>
#include <cardiac/report/tables.hpp>
#include <cardiac/report/text.hpp>

namespace cardiac {
namespace {

/// A part of the wall round the axis. Okabe & Ito's colours, apart for every common kind of colour blindness,
/// without the yellow that is hard to see on white; dashes beside them, for print without colours.
struct Wall {
  std::string_view name, colour, dash;
};
constexpr Wall kAnterior{"anterior", "#d55e00", ""}, kAnteroseptal{"anteroseptal", "#cc79a7", "8 3"},
    kInferoseptal{"inferoseptal", "#56b4e9", "2 2"}, kInferior{"inferior", "#0072b2", ""},
    kInferolateral{"inferolateral", "#009e73", "8 3"}, kAnterolateral{"anterolateral", "#b08900", "2 2"},
    kApicalSeptal{"apical septal", "#56b4e9", ""}, kLateral{"apical lateral", "#009e73", ""},
    kApex{"apex", "#111111", "10 3 2 3"};

struct Curve {
  int segment;
  Wall wall;
};
struct Level {
  std::string_view name;
  std::vector<Curve> curves;
};
struct Chamber {
  std::string title;
  std::array<Level, 3> levels;
};

Chamber left_chamber() {
  constexpr std::array kRound{kAnterior, kAnteroseptal,  kInferoseptal,
                              kInferior, kInferolateral, kAnterolateral};
  std::vector<Curve> basal, mid;
  for (int i = 0; i < 6; ++i) {
    basal.push_back({1 + i, kRound.at(i)});
    mid.push_back({7 + i, kRound.at(i)});
  }
  return {"Strain of the left ventricle's segments",
          {{{"basal", basal},
            {"mid", mid},
            {"apical and apex",
             {{13, kAnterior}, {14, kApicalSeptal}, {15, kInferior}, {16, kLateral}, {17, kApex}}}}}};
}

Chamber right_chamber() {
  return {"Strain of the right ventricle's free wall",
          {{{"basal", {{18, kAnterior}, {19, kAnterolateral}, {20, kInferolateral}, {21, kInferior}}},
            {"mid", {{22, kAnterior}, {23, kAnterolateral}, {24, kInferolateral}, {25, kInferior}}},
            {"apical and apex", {{26, kAnterior}, {27, kLateral}, {28, kInferior}, {29, kApex}}}}}};
}

std::string stroke(const Wall& wall) {
  std::string style =
      "stroke=\"" + std::string(wall.colour) + "\" stroke-width=\"1.9\" stroke-linejoin=\"round\"";
  if (!wall.dash.empty()) style += " stroke-dasharray=\"" + std::string(wall.dash) + "\"";
  return style;
}

struct Strain {
  std::string_view title;
  double SegmentStrain::*strain;
};
constexpr std::array<Strain, 3> kStrains{{{"Longitudinal", &SegmentStrain::longitudinal},
                                          {"Circumferential", &SegmentStrain::circumferential},
                                          {"Radial", &SegmentStrain::radial}}};

/// Of the segments of both ventricles, so that all panels of one strain can be compared.
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

void draw_marks(Svg& svg, const Plot& plot, const BeatResult& result, const CardiacTimes& times) {
  if (!has_systole(result)) return;
  for (const auto& [time, name] : {std::pair{times.ed_ms, "ED"}, std::pair{times.es_ms, "ES"}}) {
    if (time < plot.x.low || time > plot.x.high) continue;
    const double x = plot.at(time, plot.y.low).x;
    svg.line({x, plot.top}, {x, plot.top + plot.height},
             "stroke=\"#333333\" stroke-width=\"1.1\" stroke-dasharray=\"1.5 2.5\"");
    const bool at_edge = x - plot.left < 12;
    svg.text({x + (at_edge ? 1 : 0), plot.top - 9}, name,
             {12, "#333333", at_edge ? Anchor::start : Anchor::middle, true});
  }
}

/// Segment numbers right of their curves at one time, moved apart where they would lie on each other.
struct NumberLabel {
  int segment;
  std::string_view colour;
  double curve_y, y;
};

void draw_numbers(Svg& svg, const Plot& plot, double x, std::vector<NumberLabel> labels) {
  constexpr double kFont = 12, kApart = 12.5, kReach = 16;
  std::ranges::sort(labels, {}, &NumberLabel::curve_y);
  for (size_t i = 1; i < labels.size(); ++i) labels[i].y = std::max(labels[i].y, labels[i - 1].y + kApart);
  double limit = plot.top + plot.height - kApart / 2;
  for (size_t i = labels.size(); i-- > 0; limit = labels[i].y - kApart)
    labels[i].y = std::min(labels[i].y, limit);
  for (const NumberLabel& label : labels) {
    svg.line({x, label.curve_y}, {x + kReach, label.y},
             "stroke=\"" + std::string(label.colour) + "\" stroke-width=\"0.9\"");
    const std::string number = std::to_string(label.segment);
    const double width = text_width(number, kFont, true);
    svg.rect({x + kReach, label.y - 6}, width + 3, 12, "fill=\"#ffffff\" fill-opacity=\"0.85\"");
    svg.text({x + kReach + 1.5, label.y}, number, {kFont, std::string(label.colour), Anchor::start, true});
  }
}

void draw_curves(Svg& svg, const Plot& plot, const BeatResult& result, const Level& level,
                 double SegmentStrain::*strain, double label_ms) {
  std::vector<NumberLabel> labels;
  for (const Curve& curve : level.curves) {
    const auto segment = std::ranges::find(result.segments, curve.segment, &SegmentInfo::number);
    if (segment == result.segments.end()) continue;
    const auto index = static_cast<size_t>(segment - result.segments.begin());
    std::vector<DrawPoint> points;
    double nearest = INFINITY, y = 0;
    for (const Instant& instant : result.instants) {
      if (index >= instant.strain.size() || !std::isfinite(instant.strain[index].*strain)) continue;
      points.push_back(plot.at(instant.time_ms, 100 * instant.strain[index].*strain));
      if (const double away = std::abs(instant.time_ms - label_ms); away < nearest)
        nearest = away, y = points.back().y;
    }
    const Wall& wall = curve.wall;
    svg.polyline(points, stroke(wall), std::to_string(segment->number) + " " + segment->name);
    if (!points.empty()) labels.push_back({curve.segment, wall.colour, y, y});
  }
  draw_numbers(svg, plot, plot.at(label_ms, 0).x, labels);
}

void draw_legend(Svg& svg, DrawPoint corner, double right, const Chamber& chamber) {
  std::vector<std::string_view> drawn;
  DrawPoint at = corner;
  for (const Level& level : chamber.levels) {
    for (const Curve& curve : level.curves) {
      const Wall& wall = curve.wall;
      if (std::ranges::find(drawn, wall.name) != drawn.end()) continue;
      drawn.push_back(wall.name);
      const double width = 31 + text_width(wall.name, 12.5, false) + 14;
      if (at.x + width > right) at = {corner.x, at.y + 21};
      svg.line(at, {at.x + 26, at.y}, stroke(wall));
      svg.text({at.x + 31, at.y}, wall.name, {12.5, "#222222"});
      at.x += width;
    }
  }
}

std::string drawn(const Chamber& chamber, const BeatResult& result) {
  constexpr double kLeft = 66, kPanelWidth = 268, kGap = 22, kPanelHeight = 190, kPitch = 240, kTop = 92;
  constexpr double kWidth = kLeft + 3 * kPanelWidth + 2 * kGap + 18;
  Svg svg(
      kWidth, kTop + 3 * kPitch + 58, chamber.title,
      "Longitudinal, circumferential and radial strain in percent against time in milliseconds, a row each, "
      "with a panel for the basal, mid and apical level; one curve a segment; the numbers are in "
      "strain.csv");
  svg.text({kLeft, 22}, chamber.title, {17, "#222222", Anchor::start, true});
  const double first = result.instants.empty() ? 0 : result.instants.front().time_ms;
  const double last = result.instants.empty() ? 1 : result.instants.back().time_ms;
  const CardiacTimes times = cardiac_times(result);
  // Without a systole the curves are apart at the end of the loading: their numbers stand before it.
  const double label_ms = has_systole(result) ? times.es_ms : last - 0.14 * (last - first);
  for (size_t row = 0; row < kStrains.size(); ++row) {
    const Axis axis = strain_axis(result, kStrains[row].strain);
    for (size_t column = 0; column < chamber.levels.size(); ++column) {
      const Level& level = chamber.levels[column];
      const Plot plot{kLeft + (kPanelWidth + kGap) * static_cast<double>(column),
                      kTop + kPitch * static_cast<double>(row),
                      kPanelWidth,
                      kPanelHeight,
                      tight_axis(first, last, 4),
                      axis};
      const bool left = column == 0, last_row = row + 1 == kStrains.size();
      plot.draw(svg, last_row ? "time (ms)" : "",
                left ? std::string(kStrains[row].title) + " strain (%)" : "", 12.5, left);
      if (row == 0)
        svg.text({plot.left + plot.width / 2, plot.top - 30}, level.name,
                 {14, "#222222", Anchor::middle, true});
      draw_curves(svg, plot, result, level, kStrains[row].strain, label_ms);
      draw_marks(svg, plot, result, times);
    }
  }
  draw_legend(svg, {kLeft, kTop + 3 * kPitch + 18}, kWidth, chamber);
  return svg.str();
}

}  // namespace

std::string strain_curves_svg(const BeatResult& result) {
  return drawn(left_chamber(), result);
}

std::string right_strain_curves_svg(const BeatResult& result) {
  return drawn(right_chamber(), result);
}

}  // namespace cardiac
