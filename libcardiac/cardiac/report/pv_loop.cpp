#include <cardiac/report/pv_loop.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include <cardiac/report/axes.hpp>

namespace cardiac {
namespace {

struct PhaseLook {
  Phase phase;
  std::string_view name, colour;
};
constexpr std::array<PhaseLook, 4> kPhases{
    {{Phase::filling, "filling", "#0072b2"},
     {Phase::isovolumetric_contraction, "isovolumetric contraction", "#e69f00"},
     {Phase::ejection, "ejection", "#d55e00"},
     {Phase::isovolumetric_relaxation, "isovolumetric relaxation", "#009e73"}}};

bool drawable(const CavitySample& s) {
  return std::isfinite(s.volume_mL) && std::isfinite(s.pressure_mmHg);
}

Plot plot_of(const BeatResult& result) {
  double low_v = INFINITY, high_v = -INFINITY, low_p = 0, high_p = 0;
  for (const VentricleSummary& v : result.ventricles) {
    for (const CavitySample& s : v.samples) {
      if (!drawable(s)) continue;
      low_v = std::min(low_v, s.volume_mL), high_v = std::max(high_v, s.volume_mL);
      low_p = std::min(low_p, s.pressure_mmHg), high_p = std::max(high_p, s.pressure_mmHg);
    }
  }
  const double margin = 0.06 * (high_v - low_v);
  return {
      84, 50, 534, 384, round_axis(low_v - margin, high_v + margin, 7), round_axis(low_p, 1.04 * high_p, 7)};
}

/// One line for each stretch of one phase, reaching to the first sample of the next.
void draw_loop(Svg& svg, const Plot& plot, const VentricleSummary& ventricle, bool has_beat) {
  std::vector<CavitySample> samples;
  std::ranges::copy_if(ventricle.samples, std::back_inserter(samples), drawable);
  for (size_t begin = 0; begin + 1 < samples.size();) {
    const Phase phase = samples[begin].phase;
    std::vector<DrawPoint> points;
    size_t end = begin;
    while (end < samples.size() && samples[end].phase == phase) ++end;
    for (size_t i = begin; i < std::min(end + 1, samples.size()); ++i)
      points.push_back(plot.at(samples[i].volume_mL, samples[i].pressure_mmHg));
    const auto look = std::ranges::find(kPhases, phase, &PhaseLook::phase);
    svg.polyline(points,
                 "stroke=\"" + std::string(look->colour) +
                     "\" stroke-width=\"3\" stroke-linejoin=\"round\" stroke-linecap=\"round\"",
                 has_beat ? look->name : "loading");
    begin = end;
  }
}

void draw_mark(Svg& svg, const Plot& plot, const VentricleSummary& ventricle, double time_ms,
               const std::string& name, bool right) {
  const auto nearest = std::ranges::min_element(
      ventricle.samples, {}, [time_ms](const CavitySample& s) { return std::abs(s.time_ms - time_ms); });
  if (nearest == ventricle.samples.end() || !std::isfinite(time_ms) || !drawable(*nearest)) return;
  const DrawPoint p = plot.at(nearest->volume_mL, nearest->pressure_mmHg);
  svg.circle(p, 5.5, "fill=\"#ffffff\" stroke=\"#222222\" stroke-width=\"2\"", name);
  svg.text({p.x + (right ? 11 : -11), p.y - 12}, name,
           {14, "#222222", right ? Anchor::start : Anchor::end, true});
}

void draw_legend(Svg& svg) {
  for (size_t i = 0; i < kPhases.size(); ++i) {
    const double x = 84 + 270.0 * static_cast<double>(i % 2), y = 508 + 24.0 * static_cast<double>(i / 2);
    svg.line({x, y}, {x + 28, y},
             "stroke=\"" + std::string(kPhases[i].colour) + "\" stroke-width=\"4\" stroke-linecap=\"round\"");
    svg.text({x + 38, y}, kPhases[i].name, {14, "#222222"});
  }
}

}  // namespace

std::string pv_loop_svg(const BeatResult& result) {
  const std::string title = result.has_beat ? "Pressure–volume loop" : "Pressure–volume curve";
  Svg svg(640, result.has_beat ? 552 : 500, title,
          "Cavity pressure in mmHg against cavity volume in mL; the numbers are in cavity.csv");
  svg.text({84, 24}, title, {17, "#222222", Anchor::start, true});
  const Plot plot = plot_of(result);
  plot.draw(svg, "volume (mL)", "pressure (mmHg)", 14);
  for (const VentricleSummary& v : result.ventricles) draw_loop(svg, plot, v, result.has_beat);
  for (const VentricleSummary& v : result.ventricles) {
    if (!result.has_beat) continue;
    const std::string name = v.name == "lv" ? "LV " : v.name == "rv" ? "RV " : v.name + " ";
    const std::string prefix = result.ventricles.size() > 1 ? name : "";
    // Outside of the loops where this one reaches farther than the other, otherwise within.
    const bool widest = std::ranges::all_of(
        result.ventricles, [&](const VentricleSummary& other) { return !(other.edv_mL > v.edv_mL); });
    const bool smallest = std::ranges::all_of(
        result.ventricles, [&](const VentricleSummary& other) { return !(other.esv_mL < v.esv_mL); });
    draw_mark(svg, plot, v, v.ed_time_ms, prefix + "ED", widest);
    draw_mark(svg, plot, v, v.es_time_ms, prefix + "ES", !smallest);
  }
  if (result.has_beat) draw_legend(svg);
  return svg.str();
}

}  // namespace cardiac
