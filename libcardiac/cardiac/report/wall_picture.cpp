#include <cardiac/report/wall_picture.hpp>

#include <algorithm>
#include <cmath>

#include <cardiac/report/colour_bar.hpp>

namespace cardiac {

using polyaffine::Points;
using polyaffine::Vec3;

namespace {

constexpr double kPanelWidth = 400, kTop = 96, kHeight = 430, kSide = 46;

void draw_panel(Svg& svg, const WallPicture& picture, const WallPanel& panel, const WallPlacement& place,
                const ColourRange& range) {
  const auto colour = [&](int segment) {
    const std::optional<double>& value = panel.values[static_cast<std::size_t>(segment - 1)];
    return value && std::isfinite(*value) ? range.colour(*value) : Rgb{0.8, 0.8, 0.8};
  };
  draw_wall(svg, {picture.cut, picture.segment, picture.view.camera(), panel.positions, colour}, place);
  const double middle = place.origin.x;
  svg.text({middle, 54}, panel.title, {16, "#222222", Anchor::middle, true});
  svg.text({middle, 75}, panel.note, {13, "#666666", Anchor::middle});
  svg.text({middle - kPanelWidth / 2 + 14, kTop + kHeight / 2}, picture.view.left,
           {13, "#555555", Anchor::middle, false, -90});
  svg.text({middle + kPanelWidth / 2 - 14, kTop + kHeight / 2}, picture.view.right,
           {13, "#555555", Anchor::middle, false, 90});
}

}  // namespace

std::string wall_picture_svg(const WallPicture& picture) {
  const polyaffine::Mat3 rows = picture.view.camera();
  Vec3 low = Vec3::Constant(INFINITY), high = -low;
  std::string description;
  for (const WallPanel& panel : picture.panels) {
    const Points seen = rows * panel.positions;
    if (seen.cols() > 0) {
      low = low.cwiseMin(seen.rowwise().minCoeff());
      high = high.cwiseMax(seen.rowwise().maxCoeff());
    }
    description += (description.empty() ? "The wall cut open, " : ", ") + panel.title;
  }
  const Vec3 size = high - low;
  const double scale = std::min((kPanelWidth - 2 * kSide) / size.x(), kHeight / size.y());
  const Scale& quantity = scale_of(picture.quantity);
  const double width = kPanelWidth * static_cast<double>(picture.panels.size());
  Svg svg(width, 640, picture.title, description);
  svg.text({width / 2, 24}, picture.title, {18, "#222222", Anchor::middle, true});
  for (std::size_t i = 0; i < picture.panels.size(); ++i) {
    const double middle = kPanelWidth * (static_cast<double>(i) + 0.5);
    const WallPlacement place{(low + high) / 2, scale, {middle, kTop + kHeight / 2}};
    draw_panel(svg, picture, picture.panels[i], place, quantity.range);
  }
  draw_colour_bar(svg, {width / 2 - 180, 562}, 360, quantity.range,
                  {quantity.unit, quantity.low_meaning, quantity.high_meaning});
  svg.text({width / 2, 628}, scale_statement(quantity), {12, "#666666", Anchor::middle});
  return svg.str();
}

}  // namespace cardiac
