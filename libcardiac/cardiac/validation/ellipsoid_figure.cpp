#include "cardiac/validation/ellipsoid_figure.hpp"

#include <algorithm>

#include <cardiac/report/axes.hpp>
#include <cardiac/report/text.hpp>

namespace cardiac {
namespace {

std::string stroke(const std::string& colour, double width) {
  return "stroke=\"" + colour + "\" stroke-width=\"" + coordinate(width) + "\"";
}

void draw_legend(Svg& svg, DrawPoint at, const std::string& name, const std::string& colour) {
  svg.line(at, {at.x + 26, at.y}, stroke(colour, 3));
  svg.text({at.x + 34, at.y}, name, {13});
}

void draw_profiles(Svg& svg, const polyaffine::Points& X, const std::vector<EllipsoidProfile>& profiles,
                   double factor) {
  // One scale for both axes: 30 mm high, 15 mm wide.
  const Plot plot{70, 60, 240, 480, {0, 15, 5}, {-24, 6, 6}};
  plot.draw(svg, "x (mm)", "z (mm)", 13);
  const auto line = [&](const polyaffine::Points& x, const std::string& colour, double width,
                        const std::string& name) {
    std::vector<DrawPoint> points;
    for (Eigen::Index q = 0; q < x.cols(); ++q) points.push_back(plot.at(x(0, q), x(2, q)));
    svg.polyline(points, stroke(colour, width), name);
  };
  line(X, "#999999", 1.5, "undeformed");
  double y = 84;
  draw_legend(svg, {330, y}, "undeformed", "#999999");
  for (std::size_t k = 0; k < profiles.size(); ++k) {
    const auto& p = profiles[k];
    line(X + factor * p.u, p.colour, k == 0 ? 5 : 2, p.name);
    draw_legend(svg, {330, y += 24}, p.name, p.colour);
  }
  svg.text({330, y + 28}, "displacements × " + display_text(factor, 0), {13});
}

void draw_errors(Svg& svg, const std::vector<EllipsoidCurve>& curves) {
  std::vector<double> unknowns, errors;
  for (const EllipsoidCurve& curve : curves)
    for (const EllipsoidPoint& p : curve.points) {
      unknowns.push_back(p.unknowns);
      errors.push_back(p.error_percent);
    }
  const auto axis = [](const std::vector<double>& values) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return log_axis(*low, *high);
  };
  const Plot plot{650, 60, 400, 480, axis(unknowns), axis(errors)};
  plot.draw(svg, "unknowns", "displacement error (%)", 13);
  double y = 60 + 480 - 72;  // below the curves, which fall to the right
  for (const EllipsoidCurve& curve : curves) {
    if (curve.points.empty()) continue;
    std::vector<DrawPoint> points;
    for (const EllipsoidPoint& p : curve.points) points.push_back(plot.at(p.unknowns, p.error_percent));
    svg.polyline(points, stroke(curve.colour, 2), curve.name);
    for (const DrawPoint& p : points) svg.circle(p, 4, "fill=\"" + curve.colour + "\"", curve.name);
    draw_legend(svg, {670, y}, curve.name, curve.colour);
    y += 24;
  }
}

}  // namespace

std::string ellipsoid_svg(const polyaffine::Points& X, const std::vector<EllipsoidProfile>& profiles,
                          double factor, const std::vector<EllipsoidCurve>& curves) {
  Svg svg(
      1080, 610, "Truncated ellipsoid under pressure",
      "Outer surface in the half plane (x⁺, 0, z) by full-order and reduced models, and their error against "
      "the number of unknowns; the numbers are in ellipsoid.csv");
  svg.text({70, 28}, "Outer surface", {16, "#222222", Anchor::start, true});
  svg.text({650, 28}, "Error against unknowns", {16, "#222222", Anchor::start, true});
  draw_profiles(svg, X, profiles, factor);
  draw_errors(svg, curves);
  return svg.str();
}

}  // namespace cardiac
