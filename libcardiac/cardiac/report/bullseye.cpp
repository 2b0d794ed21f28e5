#include <cardiac/report/bullseye.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <cardiac/report/text.hpp>

namespace cardiac {
namespace {

constexpr DrawPoint kCentre{230, 262};
constexpr double kRadius = 186;
constexpr double kDegree = std::numbers::pi / 180;

DrawPoint on_disc(double radius, double angle_deg) {
  return {kCentre.x + kRadius * radius * std::cos(angle_deg * kDegree),
          kCentre.y - kRadius * radius * std::sin(angle_deg * kDegree)};
}

std::string point_text(DrawPoint p) {
  return coordinate(p.x) + " " + coordinate(p.y);
}

std::string sector_path(const BullseyeCell& cell) {
  const auto arc = [](double radius, int sweep, DrawPoint to) {
    const std::string r = coordinate(kRadius * radius);
    return " A" + r + " " + r + " 0 0 " + std::to_string(sweep) + " " + point_text(to);
  };
  return "M" + point_text(on_disc(cell.inner, cell.from_deg)) + " L" +
         point_text(on_disc(cell.outer, cell.from_deg)) +
         arc(cell.outer, 0, on_disc(cell.outer, cell.to_deg)) + " L" +
         point_text(on_disc(cell.inner, cell.to_deg)) +
         arc(cell.inner, 1, on_disc(cell.inner, cell.from_deg)) + " Z";
}

ColourRange range_of(const Bullseye& bullseye) {
  double low = INFINITY, high = -INFINITY;
  for (const auto& value : bullseye.values) {
    if (!value || !std::isfinite(*value)) continue;
    low = std::min(low, *value);
    high = std::max(high, *value);
  }
  if (bullseye.scale == ColourScale::sequential) return {round_axis(low, high, 5), bullseye.scale};
  return diverging_range(low, high);
}

void draw_cells(Svg& svg, const Bullseye& bullseye, const ColourRange& range) {
  for (int segment = 1; segment <= 17; ++segment) {
    const BullseyeCell cell = bullseye_cell(segment);
    const std::optional<double>& value = bullseye.values[static_cast<size_t>(segment - 1)];
    const bool known = value && std::isfinite(*value);
    const Rgb colour = known ? range.colour(*value) : Rgb{0.88, 0.88, 0.88};
    const std::string style = "fill=\"" + colour.hex() + "\" stroke=\"#ffffff\" stroke-width=\"2\"";
    const std::string text = known ? display_text(*value, bullseye.decimals) : "–";
    const std::string tooltip = "Segment " + std::to_string(segment) + ": " + text + " " + bullseye.unit;
    if (cell.inner == 0)
      svg.circle(kCentre, kRadius * cell.outer, style, tooltip);
    else
      svg.path(sector_path(cell), style, tooltip);
    const DrawPoint middle = {kCentre.x + kRadius * cell.centre().x, kCentre.y - kRadius * cell.centre().y};
    const std::string ink = colour.readable_text();
    svg.text({middle.x, middle.y - 10}, std::to_string(segment), {11, ink, Anchor::middle});
    svg.text({middle.x, middle.y + 6}, text, {14, ink, Anchor::middle, true});
  }
}

void draw_walls(Svg& svg) {
  const double away = kRadius + 16;
  const auto label = [&](DrawPoint offset, std::string_view text, double rotate) {
    svg.text({kCentre.x + offset.x, kCentre.y + offset.y}, text,
             {13, "#555555", Anchor::middle, false, rotate});
  };
  label({0, -away}, "anterior", 0);
  label({0, away}, "inferior", 0);
  label({-away, 0}, "septal", -90);
  label({away, 0}, "lateral", 90);
}

}  // namespace

DrawPoint BullseyeCell::centre() const {
  const double radius = inner == 0 ? 0 : (inner + outer) / 2;
  const double angle = (from_deg + to_deg) / 2 * kDegree;
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

BullseyeCell bullseye_cell(int segment) {
  if (segment < 1 || segment > 17) throw std::out_of_range("a bull's-eye has the segments 1 to 17");
  constexpr double kCap = 0.22, kApical = 0.48, kMid = 0.74;
  if (segment == 17) return {0, kCap, 0, 360};
  if (segment >= 13) {
    const double from = 45 + 90.0 * (segment - 13);
    return {kCap, kApical, from, from + 90};
  }
  const double from = 60 + 60.0 * ((segment - 1) % 6);
  return segment <= 6 ? BullseyeCell{kMid, 1, from, from + 60} : BullseyeCell{kApical, kMid, from, from + 60};
}

std::string bullseye_svg(const Bullseye& bullseye) {
  std::string description = "Bull's-eye of the 17 AHA segments, in " + bullseye.unit + ":";
  for (size_t i = 0; i < bullseye.values.size(); ++i)
    if (bullseye.values[i])
      description +=
          " " + std::to_string(i + 1) + ": " + display_text(*bullseye.values[i], bullseye.decimals) + ";";
  description.back() = '.';
  Svg svg(460, 554, bullseye.title, description);
  svg.text({kCentre.x, 24}, bullseye.title, {18, "#222222", Anchor::middle, true});
  const ColourRange range = range_of(bullseye);
  draw_cells(svg, bullseye, range);
  draw_walls(svg);
  draw_colour_bar(svg, {70, 490}, 320, range, {bullseye.unit, bullseye.low_meaning, bullseye.high_meaning});
  return svg.str();
}

}  // namespace cardiac
