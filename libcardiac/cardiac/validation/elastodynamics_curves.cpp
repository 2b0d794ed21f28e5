#include "cardiac/validation/elastodynamics_curves.hpp"

#include <algorithm>
#include <cmath>

#include <cardiac/core/csv_reader.hpp>
#include <cardiac/report/axes.hpp>
#include <cardiac/report/csv_writer.hpp>
#include <cardiac/report/text.hpp>

namespace cardiac {

using polyaffine::Vector;

namespace {

constexpr const char* kComponents[] = {"ux", "uy", "uz"};
constexpr double kMm_per_m = 1000, kMs_per_s = 1000;

Vector column(const CsvTable& table, const std::string& name, double factor) {
  const std::size_t at = table.column(name);
  Vector out(static_cast<Eigen::Index>(table.rows()));
  for (std::size_t row = 0; row < table.rows(); ++row)
    out[static_cast<Eigen::Index>(row)] = factor * table.number(row, at);
  return out;
}

// A run tells every millisecond.
Eigen::Index sample_at(double time_ms) {
  return static_cast<Eigen::Index>(std::lround(time_ms));
}

std::string stroke(const std::string& colour, double width) {
  return "stroke=\"" + colour + "\" stroke-width=\"" + coordinate(width) + "\"";
}

void draw_range(Svg& svg, const Plot& plot, const Vector& times, const GroupCurves& groups) {
  std::string d;
  const auto add = [&](double t, double value, const char* command) {
    const DrawPoint p = plot.at(t, value);
    d += command + coordinate(p.x) + ' ' + coordinate(p.y);
  };
  for (Eigen::Index k = 0; k < times.size(); ++k) add(times[k], groups.high[k], k == 0 ? "M" : "L");
  for (Eigen::Index k = times.size() - 1; k >= 0; --k) add(times[k], groups.low[k], "L");
  svg.path(d + "Z", "fill=\"#cccccc\" stroke=\"none\"", "range of the groups");
}

void draw_panel(Svg& svg, const Plot& plot, const Vector& times, const GroupCurves& groups, std::size_t point,
                int component, const std::vector<DrawnRun>& runs) {
  draw_range(svg, plot, times, groups);
  std::vector<DrawPoint> median;
  for (Eigen::Index k = 0; k < times.size(); ++k) median.push_back(plot.at(times[k], groups.median[k]));
  svg.polyline(median, stroke("#777777", 1), "median of the groups");
  for (const DrawnRun& drawn : runs) {
    std::vector<DrawPoint> line;
    const auto& u = drawn.run->displacements[point];
    for (Eigen::Index k = 0; k < u.cols(); k += 5)
      line.push_back(plot.at(drawn.run->times_ms[k], u(component, k)));
    svg.polyline(line, stroke(drawn.colour, 2), drawn.name);
  }
}

}  // namespace

GroupEnvelope read_envelope(const std::filesystem::path& file, const ElastodynamicsCase& problem) {
  const CsvTable table(file);
  GroupEnvelope out{column(table, "time_s", kMs_per_s), {}};
  for (const BenchmarkPoint& point : problem.points) {
    auto& found = out.points.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const std::string name = point.name + '_' + kComponents[k];
      found[k] = {column(table, name + "_median_m", kMm_per_m), column(table, name + "_min_m", kMm_per_m),
                  column(table, name + "_max_m", kMm_per_m)};
    }
  }
  return out;
}

std::vector<std::array<Excess, 3>> excess(const ElastodynamicsRun& run, const GroupEnvelope& envelope) {
  std::vector<std::array<Excess, 3>> out(envelope.points.size());
  for (std::size_t p = 0; p < out.size(); ++p)
    for (int component = 0; component < 3; ++component) {
      Excess& found = out[p][static_cast<std::size_t>(component)];
      const GroupCurves& groups = envelope.points[p][static_cast<std::size_t>(component)];
      double inside = 0, count = 0, squares = 0;
      for (Eigen::Index k = 0; k < envelope.times_ms.size(); ++k) {
        const Eigen::Index at = sample_at(envelope.times_ms[k]);
        if (at >= run.times_ms.size()) break;
        const double u = run.displacements[p](component, at);
        const double beyond = std::max({0.0, groups.low[k] - u, u - groups.high[k]});
        if (beyond > found.largest_mm) {
          found.largest_mm = beyond;
          found.at_ms = envelope.times_ms[k];
        }
        inside += beyond <= kCurveTolerance_mm ? 1 : 0;
        squares += std::pow(u - groups.median[k], 2);
        ++count;
      }
      if (count == 0) continue;
      found.share_inside = inside / count;
      found.rms_to_median_mm = std::sqrt(squares / count);
    }
  return out;
}

std::string elastodynamics_svg(const ElastodynamicsCase& problem, const GroupEnvelope& envelope,
                               const std::vector<DrawnRun>& runs) {
  constexpr double kWide = 300, kHigh = 190, kLeft = 80, kTop = 70;
  const double height = kTop + static_cast<double>(problem.points.size()) * (kHigh + 60) + 10;
  Svg svg(
      kLeft + 3 * (kWide + 75), height, "Elastodynamics: " + problem.title,
      "Displacement of points against time: the range of the groups of Aróstica et al. 2025 (grey), their "
      "median, and the models; the numbers are in the table beside it");
  double x = kLeft;
  const auto legend = [&](const std::string& name, const std::string& colour) {
    svg.line({x, 28}, {x + 26, 28}, stroke(colour, 4));
    svg.text({x + 34, 28}, name, {13});
    x += 60 + text_width(name, 13, false);
  };
  legend("groups of Aróstica et al. 2025", "#cccccc");
  for (const DrawnRun& drawn : runs) legend(drawn.name, drawn.colour);
  for (std::size_t p = 0; p < problem.points.size(); ++p)
    for (int k = 0; k < 3; ++k) {
      const GroupCurves& groups = envelope.points[p][static_cast<std::size_t>(k)];
      double low = groups.low.minCoeff(), high = groups.high.maxCoeff();
      for (const DrawnRun& drawn : runs) {
        low = std::min(low, drawn.run->displacements[p].row(k).minCoeff());
        high = std::max(high, drawn.run->displacements[p].row(k).maxCoeff());
      }
      const Plot plot{kLeft + k * (kWide + 75),
                      kTop + static_cast<double>(p) * (kHigh + 60),
                      kWide,
                      kHigh,
                      round_axis(0, envelope.times_ms.maxCoeff(), 5),
                      round_axis(low, high, 5)};
      plot.draw(svg, "time (ms)", problem.points[p].name + " " + kComponents[k] + " (mm)", 12);
      draw_panel(svg, plot, envelope.times_ms, groups, p, k, runs);
    }
  return svg.str();
}

std::string elastodynamics_csv(const ElastodynamicsCase& problem, const std::vector<DrawnRun>& runs) {
  std::string header = "time_ms,method";
  for (const BenchmarkPoint& point : problem.points)
    for (const char* component : kComponents) header += ',' + point.name + '_' + component + "_mm";
  header += ",lv_mL";
  if (problem.two_ventricles) header += ",rv_mL";
  CsvWriter table(header, 8);
  for (const DrawnRun& drawn : runs)
    for (Eigen::Index k = 0; k < drawn.run->times_ms.size(); k += 5) {
      table << drawn.run->times_ms[k] << drawn.name;
      for (const auto& u : drawn.run->displacements)
        for (int component = 0; component < 3; ++component) table << u(component, k);
      for (Eigen::Index cavity = 0; cavity < drawn.run->volumes_mL.rows(); ++cavity)
        table << drawn.run->volumes_mL(cavity, k);
      table.end_row();
    }
  return table.text();
}

}  // namespace cardiac
