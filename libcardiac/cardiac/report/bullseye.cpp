#include <cardiac/report/bullseye.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <cardiac/report/text.hpp>

namespace cardiac {
namespace {

constexpr double kWidth = 520, kLegendLine = 22;
constexpr std::array<std::string_view, 3> kDashes{"", "9 5", "2 4"};

struct WallLabel {
  double x, y, rotate;
  std::string_view text;
};

struct Look {
  BullseyeDisc disc;
  BullseyeCells cells;
  std::vector<WallLabel> walls;
  double bottom = 0;  ///< of disc and wall labels
  std::string of;
};

Look left_look() {
  constexpr double kCx = kWidth / 2, kCy = 308, kR = 212, kAway = kR + 20;
  return {{{kCx, kCy}, kR},
          left_cells(),
          {{kCx, kCy - kAway, 0, "anterior"},
           {kCx, kCy + kAway, 0, "inferior"},
           {kCx - kAway, kCy, -90, "septal"},
           {kCx + kAway, kCy, 90, "lateral"}},
          kCy + kAway + 8,
          "the 17 AHA segments"};
}

Look right_look() {
  constexpr double kCx = 376, kCy = 330, kR = 236, kAway = 20;
  return {{{kCx, kCy}, kR},
          right_cells(),
          {{kCx - 36, kCy - kR - kAway, 0, "anterior"},
           {kCx - 36, kCy + kR + kAway, 0, "inferior"},
           {kCx - kR - kAway, kCy, -90, "lateral"},
           {kCx + kAway, kCy, 90, "septum and left ventricle"}},
          kCy + kR + kAway + 8,
          "the 12 segments of the right free wall"};
}

std::vector<NamedRegion> regions_among(const std::vector<NamedRegion>& regions, const BullseyeCells& cells) {
  std::vector<NamedRegion> list;
  for (const NamedRegion& region : regions) {
    NamedRegion here{region.name, {}};
    std::ranges::copy_if(region.segments, std::back_inserter(here.segments),
                         [&](int s) { return cells.contains(s); });
    list.push_back(std::move(here));  // an empty one keeps its letter
  }
  return list;
}

/// Half the sides of a label: number over value (and mark).
struct LabelSize {
  double font, half_width, half_height;
};

constexpr double kNumberSize = 0.78, kGap = 0.36, kCapital = 0.73, kMark = 0.62;  // of the value's font

LabelSize label_size(const std::string& text, bool marked, double font) {
  const double width = text_width(text, font, true) + (marked ? (kMark + 0.2) * font : 0);
  return {font, width / 2, (kCapital * (1 + kNumberSize) + kGap) * font / 2};
}

bool fits(const BullseyeDisc& disc, const BullseyeCell& cell, const LabelSize& size) {
  constexpr double kClear = 3.5;  // from the middle of the border's stroke
  constexpr int kSteps = 8;
  const DrawPoint middle = cell.centre();
  for (int i = -kSteps; i <= kSteps; ++i) {
    for (const double side : {-1.0, 1.0}) {
      const double s = static_cast<double>(i) / kSteps;
      for (const auto& [sx, sy] : {std::pair{s, side}, {side, s}}) {
        const double x = middle.x + sx * (size.half_width + kClear) / disc.radius;
        const double y = middle.y + sy * (size.half_height + kClear) / disc.radius;
        if (!cell.holds(std::hypot(x, y), std::atan2(y, x) * 180 / std::numbers::pi)) return false;
      }
    }
  }
  return true;
}

LabelSize fitted_label(const BullseyeDisc& disc, const BullseyeCell& cell, const std::string& text,
                       bool marked) {
  constexpr double kLargest = 15, kSmallest = 7;
  for (double font = kLargest; font > kSmallest; font -= 0.5)
    if (const LabelSize size = label_size(text, marked, font); fits(disc, cell, size)) return size;
  return label_size(text, marked, kSmallest);
}

void draw_label(Svg& svg, const Look& look, int segment, const std::string& text, int beyond,
                const std::string& ink) {
  const BullseyeCell& cell = look.cells.at(segment);
  const LabelSize size = fitted_label(look.disc, cell, text, beyond != 0);
  const DrawPoint middle = look.disc.at(cell.centre());
  const double number_font = kNumberSize * size.font;
  svg.text({middle.x, middle.y - size.half_height + kCapital * number_font / 2}, std::to_string(segment),
           {number_font, ink, Anchor::middle});
  const double y = middle.y + size.half_height - kCapital * size.font / 2;
  const double shift = beyond == 0 ? 0 : -beyond * (kMark + 0.2) * size.font / 2;
  svg.text({middle.x + shift, y}, text, {size.font, ink, Anchor::middle, true});
  if (beyond != 0)
    draw_beyond_mark(svg, {middle.x + beyond * (size.half_width - kMark * size.font / 2), y},
                     kMark * size.font, beyond, ink);
}

void draw_cells(Svg& svg, const Look& look, const Bullseye& bullseye) {
  const Scale& scale = scale_of(bullseye.quantity);
  for (const auto& [segment, cell] : look.cells) {
    const auto found = bullseye.values.find(segment);
    const bool known = found != bullseye.values.end() && std::isfinite(found->second);
    const Rgb colour = known ? scale.range.colour(found->second) : Rgb{0.88, 0.88, 0.88};
    const int beyond = known ? scale.range.beyond(found->second) : 0;
    const std::string text = known ? display_text(found->second, scale.decimals) : "–";
    svg.path(cell_path(look.disc, cell),
             "fill=\"" + colour.hex() + "\" stroke=\"#ffffff\" stroke-width=\"2\"",
             "Segment " + std::to_string(segment) + ": " + text + " " + scale.unit +
                 (beyond == 0 ? "" : ", beyond the scale"));
    draw_label(svg, look, segment, text, beyond, colour.readable_text());
  }
}

std::string region_stroke(size_t region) {
  const std::string style = "stroke=\"#111111\" stroke-width=\"3.2\"";
  const std::string_view dash = kDashes[region % kDashes.size()];
  return style +
         (dash.empty() ? " stroke-linecap=\"round\"" : " stroke-dasharray=\"" + std::string(dash) + "\"");
}

/// The letter of a region on a disc of its own.
void draw_badge(Svg& svg, DrawPoint at, size_t region) {
  svg.circle(at, 9, "fill=\"#111111\" stroke=\"#ffffff\" stroke-width=\"1.5\"");
  svg.text(at, std::string(1, region_letter(region)), {12, "#ffffff", Anchor::middle, true});
}

/// Beside the outline, in the middle of the outer side of the region's outermost, first segment; further
/// regions of the same segment next to it.
void draw_regions(Svg& svg, const Look& look, const std::vector<NamedRegion>& regions) {
  std::map<int, int> badges;
  for (size_t i = 0; i < regions.size(); ++i) {
    const NamedRegion& region = regions[i];
    if (region.segments.empty()) continue;
    const std::string d = outline_path(look.disc, look.cells, region.segments);
    svg.path(d, "fill=\"none\" stroke=\"#ffffff\" stroke-width=\"6\" stroke-linecap=\"round\"");
    svg.path(d, "fill=\"none\" " + region_stroke(i), region.name);
    const int first = *std::ranges::min_element(region.segments);
    const BullseyeCell& cell = look.cells.at(first);
    const double middle = (cell.from_deg + cell.to_deg) / 2 - 12.0 * badges[first]++;
    draw_badge(svg, look.disc.at(cell.outer, middle), i);
  }
}

std::string shortened(const std::string& text, double width, double font) {
  if (text_width(text, font, false) <= width) return text;
  std::string kept = text;
  while (!kept.empty() && text_width(kept + "…", font, false) > width) {
    while (!kept.empty() && (static_cast<unsigned char>(kept.back()) & 0xC0) == 0x80) kept.pop_back();
    if (!kept.empty()) kept.pop_back();
  }
  return kept + "…";
}

void draw_region_names(Svg& svg, double top, const std::vector<NamedRegion>& regions) {
  double y = top;
  for (size_t i = 0; i < regions.size(); ++i) {
    if (regions[i].segments.empty()) continue;
    svg.line({30, y}, {72, y}, region_stroke(i));
    draw_badge(svg, {51, y}, i);
    std::string text = regions[i].name + ": segment" + (regions[i].segments.size() > 1 ? "s" : "");
    for (const int s : regions[i].segments)
      text += (s == regions[i].segments.front() ? " " : ", ") + std::to_string(s);
    svg.text({82, y}, shortened(text, kWidth - 92, 13), {13, "#222222"});
    y += kLegendLine;
  }
}

std::string description_of(const Look& look, const Bullseye& bullseye,
                           const std::vector<NamedRegion>& regions) {
  const Scale& scale = scale_of(bullseye.quantity);
  std::string text = "Bull's-eye of " + look.of + ", in " + scale.unit + ":";
  for (const auto& [segment, cell] : look.cells)
    if (const auto value = bullseye.values.find(segment); value != bullseye.values.end())
      text += " " + std::to_string(segment) + ": " + display_text(value->second, scale.decimals) + ";";
  text.back() = '.';
  for (const NamedRegion& region : regions)
    if (!region.segments.empty()) text += " Outlined: " + region.name + ".";
  return text;
}

std::string drawn(const Look& look, const Bullseye& bullseye) {
  const Scale& scale = scale_of(bullseye.quantity);
  const std::vector<NamedRegion> regions = regions_among(bullseye.regions, look.cells);
  const auto named = std::ranges::count_if(regions, [](const auto& r) { return !r.segments.empty(); });
  const double bar = look.bottom + 22, names = bar + 94;
  Svg svg(kWidth, names - 6 + kLegendLine * static_cast<double>(named), bullseye.title,
          description_of(look, bullseye, regions));
  svg.text({kWidth / 2, 24}, bullseye.title, {18, "#222222", Anchor::middle, true});
  svg.text({kWidth / 2, 46}, bullseye.note, {13, "#555555", Anchor::middle});
  draw_cells(svg, look, bullseye);
  draw_regions(svg, look, regions);
  for (const WallLabel& label : look.walls)
    svg.text({label.x, label.y}, label.text, {13, "#555555", Anchor::middle, false, label.rotate});
  draw_colour_bar(svg, {90, bar}, 340, scale.range, {scale.unit, scale.low_meaning, scale.high_meaning});
  svg.text({kWidth / 2, bar + 69}, scale_statement(scale) + "; a triangle marks a value beyond",
           {12, "#666666", Anchor::middle});
  draw_region_names(svg, names, regions);
  return svg.str();
}

}  // namespace

char region_letter(size_t index) {
  return static_cast<char>('A' + index % 26);
}

std::string bullseye_svg(const Bullseye& bullseye) {
  return drawn(left_look(), bullseye);
}

std::string right_wall_svg(const Bullseye& bullseye) {
  return drawn(right_look(), bullseye);
}

BullseyeDisc bullseye_disc() {
  return left_look().disc;
}

BullseyeDisc right_wall_disc() {
  return right_look().disc;
}

}  // namespace cardiac
