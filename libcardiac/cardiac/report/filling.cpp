#include "cardiac/report/filling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <cardiac/report/axes.hpp>
#include <cardiac/report/csv_writer.hpp>
#include <cardiac/report/text.hpp>

namespace cardiac {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

double klotz_of(const UnloadedCavity& cavity, double pressure_mmHg) {
  if (cavity.name != "lv" || cavity.pressure_mmHg <= 0) return kNone;
  return klotz_volume_mL(cavity.imaged_mL, cavity.pressure_mmHg, pressure_mmHg);
}

constexpr const char* kLeft = "#0072b2";
constexpr const char* kRight = "#d55e00";
constexpr const char* kKlotz = "#666666";

std::string stroke(const std::string& colour, const std::string& more = "") {
  return "stroke=\"" + colour + "\" stroke-width=\"3\" stroke-linejoin=\"round\"" + more;
}

}  // namespace

double klotz_volume_mL(double measured_mL, double measured_mmHg, double pressure_mmHg) {
  const double V0 = measured_mL * (0.6 - 0.006 * measured_mmHg);
  return V0 + (measured_mL - V0) * std::pow(pressure_mmHg / measured_mmHg, 1 / 2.76);
}

std::string filling_table(const UnloadingResult& unloading) {
  CsvWriter csv("ventricle,pressure_mmHg,volume_mL,klotz_volume_mL");
  for (const UnloadedCavity& cavity : unloading.cavities)
    for (std::size_t k = 0; k < cavity.volumes_mL.size(); ++k) {
      const double p = cavity.pressures_mmHg[k];
      csv << cavity.name << p << cavity.volumes_mL[k] << klotz_of(cavity, p);
      csv.end_row();
    }
  return csv.text();
}

std::string filling_svg(const UnloadingResult& unloading) {
  Svg svg(640, 530, "Passive filling",
          "Pressure in mmHg against volume in mL from the stress-free shape on, beside the curve of Klotz et "
          "al. 2006; the numbers are in filling.csv");
  svg.text({84, 24}, "Passive filling from the stress-free shape", {17, "#222222", Anchor::start, true});
  double low = INFINITY, high = -INFINITY, most_mmHg = 0;
  const auto widen = [&](double volume_mL) {
    if (!std::isfinite(volume_mL)) return;
    low = std::min(low, volume_mL);
    high = std::max(high, volume_mL);
  };
  for (const UnloadedCavity& cavity : unloading.cavities)
    for (std::size_t k = 0; k < cavity.volumes_mL.size(); ++k) {
      widen(cavity.volumes_mL[k]);
      widen(klotz_of(cavity, cavity.pressures_mmHg[k]));
      most_mmHg = std::max(most_mmHg, cavity.pressures_mmHg[k]);
    }
  const double margin = 0.06 * (high - low);
  const Plot plot{
      84, 50, 534, 384, round_axis(low - margin, high + margin, 7), round_axis(0, 1.04 * most_mmHg, 7)};
  plot.draw(svg, "volume (mL)", "pressure (mmHg)", 14);
  double x = 84;
  const auto legend = [&](const std::string& name, const std::string& style) {
    svg.line({x, 508}, {x + 28, 508}, style);
    svg.text({x + 36, 508}, name, {14, "#222222"});
    x += 60 + text_width(name, 14, false);
  };
  for (const UnloadedCavity& cavity : unloading.cavities) {
    const bool left = cavity.name == "lv";
    std::vector<DrawPoint> model, klotz;
    for (std::size_t k = 0; k < cavity.volumes_mL.size(); ++k)
      model.push_back(plot.at(cavity.volumes_mL[k], cavity.pressures_mmHg[k]));
    constexpr int kPieces = 60;
    for (int k = 0; k <= kPieces && !cavity.pressures_mmHg.empty(); ++k) {
      const double p = cavity.pressures_mmHg.back() * k / kPieces;
      if (const double V = klotz_of(cavity, p); std::isfinite(V)) klotz.push_back(plot.at(V, p));
    }
    if (!klotz.empty()) {
      const std::string style = stroke(kKlotz, " stroke-dasharray=\"7 5\"");
      svg.polyline(klotz, style, "Klotz et al. 2006");
      legend("Klotz et al. 2006", style);
    }
    const std::string name = left ? "left ventricle" : "right ventricle";
    svg.polyline(model, stroke(left ? kLeft : kRight), name);
    legend(name, stroke(left ? kLeft : kRight));
    svg.circle(plot.at(cavity.imaged_mL, cavity.pressure_mmHg), 5.5,
               "fill=\"#ffffff\" stroke=\"#222222\" stroke-width=\"2\"", "image");
  }
  return svg.str();
}

std::string unloading_text(const UnloadingResult& u) {
  std::string text = "imaged";
  for (const UnloadedCavity& cavity : u.cavities)
    text += (cavity.name == "lv" ? " at " : ", right ") + display_text(cavity.pressure_mmHg, 1) + " mmHg (" +
            display_text(cavity.imaged_mL, 1) + " mL, free of stress " + display_text(cavity.unloaded_mL, 1) +
            " mL, reloaded " + display_text(cavity.reloaded_mL, 1) + " mL)";
  return text + "; " + std::to_string(u.inflations) + " inflations (" +
         (u.method == "fem" ? "full order" : "reduced") + "), the reloaded shape is up to " +
         display_text(u.distance_mm, 3) + " mm off, root mean square " + display_text(u.mean_distance_mm, 3) +
         " mm";
}

}  // namespace cardiac
