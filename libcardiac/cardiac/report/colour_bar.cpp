#include <cardiac/report/colour_bar.hpp>

#include <algorithm>
#include <cmath>

namespace cardiac {

Rgb ColourRange::colour(double value) const {
  const double s = (value - axis.low) / (axis.high - axis.low);
  return scale == ColourScale::diverging ? diverging_colour(2 * s - 1) : sequential_colour(s);
}

int ColourRange::beyond(double value) const {
  return value < axis.low ? -1 : value > axis.high ? 1 : 0;
}

void draw_beyond_mark(Svg& svg, DrawPoint at, double size, int side, std::string_view colour) {
  const double half = size / 2, base = at.x - side * half;
  svg.path("M" + coordinate(base) + " " + coordinate(at.y - half) + " L" + coordinate(at.x + side * half) +
               " " + coordinate(at.y) + " L" + coordinate(base) + " " + coordinate(at.y + half) + " Z",
           "fill=\"" + std::string(colour) + "\"",
           side < 0 ? "below the lowest value of the scale" : "above the highest value of the scale");
}

void draw_colour_bar(Svg& svg, DrawPoint corner, double width, const ColourRange& range,
                     const ColourBarText& text) {
  constexpr double kHeight = 16;
  constexpr int kSteps = 160;
  for (int i = 0; i < kSteps; ++i) {
    const double value = range.axis.low + (range.axis.high - range.axis.low) * (i + 0.5) / kSteps;
    // Each stripe reaches under the next one: no hairlines between them.
    const double stripe = width / kSteps * (i + 1 < kSteps ? 2 : 1);
    svg.rect({corner.x + width * i / kSteps, corner.y}, stripe, kHeight,
             "fill=\"" + range.colour(value).hex() + "\"");
  }
  svg.rect(corner, width, kHeight, "fill=\"none\" stroke=\"#666666\" stroke-width=\"0.8\"");
  for (const int side : {-1, 1}) {
    const double end = side < 0 ? range.axis.low : range.axis.high;
    if (range.scale == ColourScale::sequential && side < 0) continue;  // Nothing comes before the first.
    draw_beyond_mark(svg, {corner.x + (side < 0 ? -10 : width + 10), corner.y + kHeight / 2}, 13, side,
                     range.colour(end).hex());
  }
  for (const double tick : range.axis.ticks()) {
    const double x = corner.x + width * (tick - range.axis.low) / (range.axis.high - range.axis.low);
    svg.line({x, corner.y + kHeight}, {x, corner.y + kHeight + 4}, "stroke=\"#666666\" stroke-width=\"1\"");
    svg.text({x, corner.y + kHeight + 13}, range.axis.label(tick), {13, "#444444", Anchor::middle});
  }
  svg.text({corner.x + width + 26, corner.y + kHeight / 2}, text.unit, {14, "#222222"});
  svg.text({corner.x, corner.y + kHeight + 33}, text.low_meaning, {12, "#666666"});
  svg.text({corner.x + width, corner.y + kHeight + 33}, text.high_meaning, {12, "#666666", Anchor::end});
}

}  // namespace cardiac
