#include "cardiac/validation/cube_figure.hpp"

#include <algorithm>
#include <functional>
#include <iomanip>
#include <locale>
#include <sstream>

#include <cardiac/report/axes.hpp>

namespace cardiac {
namespace {

constexpr double kLeft = 84, kTop = 60, kWidth = 560, kHeight = 380;

struct Curve {
  std::string name, colour;
  std::function<double(const CubeTable&, const PaperCell&)> percent;
};

double tilt(const CubeTable& table, const PaperCell& cell, CubeWeights weights) {
  return table.row(cell, {}, weights).tilt_percent;
}

const std::vector<Curve>& curves() {
  static const std::vector<Curve> all{
      {"paper (±)", "#8c8c8c", [](const CubeTable&, const PaperCell& c) { return c.spread_percent; }},
      {"region volumes as weights", "#c44e52",
       [](const CubeTable& t, const PaperCell& c) { return tilt(t, c, CubeWeights::volumes); }},
      {"consistent weights", "#2a7f62",
       [](const CubeTable& t, const PaperCell& c) { return tilt(t, c, CubeWeights::consistent); }}};
  return all;
}

// Two digits, small numbers as a power of ten.
std::string percent_text(double percent) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << std::setprecision(2) << percent << " %";
  return out.str();
}

double largest_of(const CubeTable& table, const Curve& curve) {
  double largest = 0;
  for (const PaperCell& cell : paper_table()) largest = std::max(largest, curve.percent(table, cell));
  return largest;
}

double largest_tilt(const CubeTable& table) {
  double largest = 0;
  for (const Curve& curve : curves()) largest = std::max(largest, largest_of(table, curve));
  return largest;
}

}  // namespace

std::string cube_svg(const CubeTable& table) {
  Svg svg(kLeft + kWidth + 30, kTop + kHeight + 130, "Tilt of the cube's faces under random sampling",
          "Tilt in percent of the thickness change against the number of integration "
          "points, for 5 and 9 zones: the paper, region volumes as weights, consistent weights; the numbers "
          "are in cube.csv");
  const Plot plot{
      kLeft, kTop, kWidth, kHeight, tight_axis(100, 1500, 7), round_axis(0, largest_tilt(table), 6)};
  plot.draw(svg, "integration points", "tilt (% of the thickness change)", 14);
  svg.text({kLeft, kTop - 28}, "Tilt of the faces of the cube", {17, "#222222", Anchor::start, true});
  double legend = kTop + kHeight + 66;
  for (const Curve& curve : curves()) {
    for (const int zones : {5, 9}) {
      std::vector<DrawPoint> line;
      for (const PaperCell& cell : paper_table())
        if (cell.zones == zones) line.push_back(plot.at(cell.points, curve.percent(table, cell)));
      const std::string dash = zones == 9 ? " stroke-dasharray=\"6 4\"" : "";
      svg.polyline(line, "stroke=\"" + curve.colour + "\" stroke-width=\"2\"" + dash,
                   curve.name + ", " + std::to_string(zones) + " zones");
      for (const DrawPoint& p : line) svg.circle(p, 3.2, "fill=\"" + curve.colour + "\"");
    }
    svg.line({kLeft, legend}, {kLeft + 34, legend}, "stroke=\"" + curve.colour + "\" stroke-width=\"2\"");
    svg.text({kLeft + 42, legend}, curve.name + ", at most " + percent_text(largest_of(table, curve)),
             {14, "#222222"});
    legend += 22;
  }
  for (const auto& [zones, row, dash] : {std::tuple{5, 0, ""}, {9, 1, " stroke-dasharray=\"6 4\""}}) {
    const double y = kTop + kHeight + 66 + 22 * row;
    svg.line({kLeft + 400, y}, {kLeft + 434, y}, "stroke=\"#333333\" stroke-width=\"2\"" + std::string(dash));
    svg.text({kLeft + 442, y}, std::to_string(zones) + " zones", {14, "#222222"});
  }
  return svg.str();
}

}  // namespace cardiac
