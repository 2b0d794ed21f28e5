#include <cardiac/bench/bench_figure.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include <cardiac/report/axes.hpp>
#include <cardiac/report/text.hpp>

namespace cardiac {
namespace {

enum class Shape { square, circle, triangle, diamond };

struct Series {
  std::string_view method, preset, integration, name, colour;
  Shape shape;
};

// Okabe & Ito's colours, apart for every common kind of colour blindness.
constexpr std::array<Series, 7> kSeries{
    {{"fem_p1", "", "", "linear full order (unknowns)", "#7f7f7f", Shape::square},
     {"fem_p2", "", "", "quadratic full order (unknowns)", "#222222", Shape::circle},
     {"polyaffine", "fast", "cells", "fast, points of cells (nodes)", "#0072b2", Shape::triangle},
     {"polyaffine", "fast", "gauss", "fast, all Gauss points", "#0072b2", Shape::triangle},
     {"polyaffine", "accurate", "cells", "accurate, points of cells (nodes)", "#d55e00", Shape::diamond},
     {"polyaffine", "accurate", "gauss", "accurate, all Gauss points", "#d55e00", Shape::diamond},
     {"polyaffine", "", "", "affine frames of the cube (zones)", "#009e73", Shape::triangle}}};

constexpr double kPanelWidth = 400, kPanelHeight = 300, kPitchX = 500, kPitchY = 400, kLeft = 80, kTop = 130;

bool belongs(const BenchRow& row, const Series& s) {
  return row.settings.empty() && row.method == s.method && row.preset == s.preset &&
         row.integration == s.integration;
}

bool shown(const BenchRow& row) {
  return row.converged && row.errors.displacement_percent > 1e-6 && row.solve_s > 0;
}

void draw_mark(Svg& svg, DrawPoint at, const Series& series, std::string_view tooltip = {}) {
  const bool hollow = series.integration == "gauss";
  const std::string style = "fill=\"" + std::string(hollow ? "#ffffff" : series.colour) + "\" stroke=\"" +
                            std::string(series.colour) + "\" stroke-width=\"1.6\"";
  const auto p = [&](double dx, double dy) { return coordinate(at.x + dx) + " " + coordinate(at.y + dy); };
  switch (series.shape) {
    case Shape::circle:
      svg.circle(at, 5, style, tooltip);
      break;
    case Shape::square:
      svg.path("M" + p(-4.5, -4.5) + "L" + p(4.5, -4.5) + "L" + p(4.5, 4.5) + "L" + p(-4.5, 4.5) + "Z", style,
               tooltip);
      break;
    case Shape::triangle:
      svg.path("M" + p(0, -6) + "L" + p(5.5, 4.5) + "L" + p(-5.5, 4.5) + "Z", style, tooltip);
      break;
    case Shape::diamond:
      svg.path("M" + p(0, -6.5) + "L" + p(6, 0) + "L" + p(0, 6.5) + "L" + p(-6, 0) + "Z", style, tooltip);
      break;
  }
}

std::string description(const BenchRow& row, const Series& series) {
  return std::string(series.name) + ": " + std::to_string(row.dofs) + " unknowns, " +
         std::to_string(row.integration_points) + " points, " + display_text(row.solve_s, 3) + " s, " +
         display_text(row.errors.displacement_percent, 2) + " %";
}

void draw_panel(Svg& svg, const SceneResult& result, double left, double top) {
  double low_x = HUGE_VAL, high_x = 0, low_y = HUGE_VAL, high_y = 0;
  for (const BenchRow& row : result.rows) {
    if (!shown(row)) continue;
    low_x = std::min(low_x, row.solve_s), high_x = std::max(high_x, row.solve_s);
    low_y = std::min(low_y, row.errors.displacement_percent);
    high_y = std::max(high_y, row.errors.displacement_percent);
  }
  const Plot plot{left, top, kPanelWidth, kPanelHeight, log_axis(low_x, high_x), log_axis(low_y, high_y)};
  plot.draw(svg, "time of solution (s)", "displacement error (%)", 13);
  svg.text({left, top - 16}, result.title, {16, "#222222", Anchor::start, true});
  for (const Series& series : kSeries) {
    std::vector<const BenchRow*> own;
    for (const BenchRow& row : result.rows)
      if (shown(row) && belongs(row, series)) own.push_back(&row);
    std::ranges::sort(own, {}, &BenchRow::dofs);
    std::vector<DrawPoint> line;
    for (const BenchRow* row : own) line.push_back(plot.at(row->solve_s, row->errors.displacement_percent));
    svg.polyline(line, "stroke=\"" + std::string(series.colour) + "\" stroke-width=\"1\" opacity=\"0.5\"");
    for (std::size_t k = 0; k < own.size(); ++k) {
      draw_mark(svg, line[k], series, description(*own[k], series));
      if (series.integration == "gauss") continue;
      const int count = own[k]->control_nodes > 0 ? own[k]->control_nodes : own[k]->dofs;
      svg.text({line[k].x + 8, line[k].y - 8}, std::to_string(count), {10, std::string(series.colour)});
    }
  }
}

}  // namespace

std::string bench_svg(const std::vector<SceneResult>& results) {
  constexpr std::ptrdiff_t kFront = 4;  // models that make a front
  std::vector<const SceneResult*> panels;
  for (const SceneResult& r : results)
    if (std::ranges::count_if(r.rows, shown) >= kFront) panels.push_back(&r);
  const auto columns = std::min<std::size_t>(2, std::max<std::size_t>(1, panels.size()));
  const std::size_t rows = (panels.size() + columns - 1) / columns;
  Svg svg(std::max(kLeft + kPitchX * static_cast<double>(columns), 780.0),
          kTop + kPitchY * static_cast<double>(rows), "Error against run time",
          "Displacement error in percent against time of solution in seconds, one panel a scene; the numbers "
          "are in bench.csv");
  for (std::size_t s = 0; s < kSeries.size(); ++s) {
    const double x = kLeft + 350 * static_cast<double>(s % 2), y = 24 + 22 * static_cast<double>(s / 2);
    draw_mark(svg, {x, y}, kSeries[s]);
    svg.text({x + 14, y}, kSeries[s].name, {13, "#222222"});
  }
  for (std::size_t i = 0; i < panels.size(); ++i)
    draw_panel(svg, *panels[i], kLeft + kPitchX * static_cast<double>(i % columns),
               kTop + kPitchY * static_cast<double>(i / columns));
  return svg.str();
}

}  // namespace cardiac
