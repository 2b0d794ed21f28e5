#include <cardiac/report/time_curves.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include <cardiac/report/axes.hpp>
#include <cardiac/report/tables.hpp>

namespace cardiac {
namespace {

struct Curve {
  std::string name, colour, dash;
  std::vector<DrawPoint> samples;  ///< time, value
};

std::string colour_of(const std::string& ventricle) {
  return ventricle == "rv" ? "#0072b2" : "#d55e00";
}

std::string short_name(const std::string& ventricle) {
  return ventricle == "lv" ? "LV" : ventricle == "rv" ? "RV" : ventricle;
}

std::vector<Curve> curves_of(const BeatResult& result, double CavitySample::*value) {
  std::vector<Curve> curves;
  for (const VentricleSummary& v : result.ventricles) {
    Curve& curve = curves.emplace_back(Curve{short_name(v.name), colour_of(v.name), "", {}});
    for (const CavitySample& s : v.samples)
      if (std::isfinite(s.time_ms) && std::isfinite(s.*value)) curve.samples.push_back({s.time_ms, s.*value});
  }
  return curves;
}

/// The pressure of the artery behind each ventricle, where the result has the circulation.
void add_arteries(const CirculationTable& table, std::vector<Curve>& curves) {
  const auto column = [&table](const std::string& name) -> const std::vector<double>* {
    const auto found = std::ranges::find(table.columns, name);
    return found == table.columns.end()
               ? nullptr
               : &table.values.at(static_cast<size_t>(found - table.columns.begin()));
  };
  const std::vector<double>* times = column("time_ms");
  if (times == nullptr) return;
  for (const auto& [name, look] :
       {std::pair{"aorta_mmHg", Curve{"aorta", colour_of("lv"), "5 3", {}}},
        std::pair{"pulmonary_artery_mmHg", Curve{"pulm. art.", colour_of("rv"), "5 3", {}}}}) {
    const std::vector<double>* pressures = column(name);
    if (pressures == nullptr) continue;
    Curve& curve = curves.emplace_back(look);
    for (size_t i = 0; i < std::min(times->size(), pressures->size()); ++i)
      if (std::isfinite((*times)[i]) && std::isfinite((*pressures)[i]))
        curve.samples.push_back({(*times)[i], (*pressures)[i]});
  }
}

Axis value_axis(const std::vector<Curve>& curves) {
  double low = 0, high = 0;
  for (const Curve& curve : curves)
    for (const DrawPoint& s : curve.samples) low = std::min(low, s.y), high = std::max(high, s.y);
  return round_axis(low, 1.04 * high, 5);
}

/// Value of the curve at a time, linear between samples; nothing outside of them.
double value_at(const std::vector<DrawPoint>& samples, double t) {
  const auto after = std::ranges::lower_bound(samples, t, {}, &DrawPoint::x);
  if (after == samples.end()) return NAN;
  if (after->x == t) return after->y;
  if (after == samples.begin()) return NAN;
  const DrawPoint& before = *(after - 1);
  return before.y + (after->y - before.y) * (t - before.x) / (after->x - before.x);
}

void draw_curves(Svg& svg, const Plot& plot, const std::vector<Curve>& curves) {
  struct Name {
    const Curve* curve;
    double y;
  };
  std::vector<Name> names;
  for (const Curve& curve : curves) {
    if (curve.samples.empty()) continue;
    std::vector<DrawPoint> points;
    points.reserve(curve.samples.size());
    for (const DrawPoint& s : curve.samples) points.push_back(plot.at(s.x, s.y));
    std::string style = "stroke=\"" + curve.colour + "\" stroke-width=\"2.4\" stroke-linejoin=\"round\"";
    if (!curve.dash.empty()) style += " stroke-dasharray=\"" + curve.dash + "\"";
    svg.polyline(points, style, curve.name);
    names.push_back({&curve, points.back().y});
  }
  std::ranges::sort(names, {}, &Name::y);
  constexpr double kApart = 15;
  for (size_t i = names.size(); i-- > 1;) names[i - 1].y = std::min(names[i - 1].y, names[i].y - kApart);
  for (const Name& name : names)
    svg.text({plot.left + plot.width + 8, name.y}, name.curve->name,
             {13, name.curve->colour, Anchor::start, true});
}

/// A hairline through the panel at ED and ES of the first ventricle, a ring on every ventricle's curve.
void draw_marks(Svg& svg, const Plot& plot, const BeatResult& result, const std::vector<Curve>& curves,
                bool named) {
  for (size_t i = 0; i < result.ventricles.size(); ++i) {
    const VentricleSummary& v = result.ventricles[i];
    for (const auto& [time, name] : {std::pair{v.ed_time_ms, "ED"}, std::pair{v.es_time_ms, "ES"}}) {
      const double value = value_at(curves[i].samples, time);
      if (!std::isfinite(value)) continue;
      const DrawPoint p = plot.at(time, value);
      if (i == 0) {
        svg.line({p.x, plot.top}, {p.x, plot.top + plot.height},
                 "stroke=\"#333333\" stroke-width=\"1.1\" stroke-dasharray=\"1.5 2.5\"");
        if (named) svg.text({p.x, plot.top - 10}, name, {13, "#333333", Anchor::middle, true});
      }
      svg.circle(p, 4.5, "fill=\"#ffffff\" stroke=\"" + curves[i].colour + "\" stroke-width=\"2\"",
                 short_name(v.name) + " " + name);
    }
  }
}

}  // namespace

std::string time_curves_svg(const BeatResult& result) {
  constexpr double kWidth = 640, kLeft = 76, kPanel = 488, kHeight = 200, kTop = 66, kPitch = 250;
  const std::string title =
      result.has_beat ? "Pressure and volume over the beat" : "Pressure and volume over the loading";
  Svg svg(
      kWidth, kTop + kPitch + kHeight + 56, title,
      "Cavity pressure in mmHg and cavity volume in mL against time in ms; the numbers are in cavity.csv");
  svg.text({kLeft, 22}, title, {17, "#222222", Anchor::start, true});
  double first = INFINITY, last = -INFINITY;
  for (const VentricleSummary& v : result.ventricles)
    for (const CavitySample& s : v.samples)
      first = std::min(first, s.time_ms), last = std::max(last, s.time_ms);
  const std::array panels{std::pair{"pressure (mmHg)", &CavitySample::pressure_mmHg},
                          std::pair{"volume (mL)", &CavitySample::volume_mL}};
  for (size_t i = 0; i < panels.size(); ++i) {
    std::vector<Curve> curves = curves_of(result, panels[i].second);
    if (i == 0) add_arteries(result.circulation, curves);
    const Plot plot{kLeft,
                    kTop + kPitch * static_cast<double>(i),
                    kPanel,
                    kHeight,
                    tight_axis(first, last, 8),
                    value_axis(curves)};
    plot.draw(svg, i + 1 == panels.size() ? "time (ms)" : "", panels[i].first, 13);
    draw_curves(svg, plot, curves);
    if (has_systole(result)) draw_marks(svg, plot, result, curves, i == 0);
  }
  return svg.str();
}

}  // namespace cardiac
