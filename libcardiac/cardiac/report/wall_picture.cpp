#include <cardiac/report/wall_picture.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <cardiac/report/colour_bar.hpp>
#include <cardiac/report/text.hpp>

namespace cardiac {

using polyaffine::Points;
using polyaffine::Vec3;

namespace {

constexpr double kPanelWidth = 400, kTop = 96, kHeight = 430, kSide = 46;

// Right, up and towards the viewer as rows.
polyaffine::Mat3 camera(const WallView& view) {
  const Vec3 front = view.towards_viewer.normalized();
  const Vec3 right = view.up.cross(front).normalized();
  polyaffine::Mat3 rows;
  rows << right.transpose(), front.cross(right).transpose(), front.transpose();
  return rows;
}

using Edge = std::pair<int, int>;

// Which faces meet at an edge, as far as a border can lie there: −1 while there is only one.
std::map<Edge, std::array<int, 2>> faces_of_edges(const WallCut& cut) {
  std::map<Edge, std::array<int, 2>> out;
  for (std::size_t f = 0; f < cut.faces.size(); ++f) {
    const auto& corners = cut.faces[f].corners;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const auto [low, high] = std::minmax(corners[k], corners[(k + 1) % corners.size()]);
      const auto [entry, added] = out.try_emplace({low, high}, std::array{static_cast<int>(f), -1});
      if (!added) entry->second[1] = static_cast<int>(f);
    }
  }
  return out;
}

struct Border {
  Edge edge;
  bool of_section = false;
};

// Borders between segments and round the section, at each of the faces that meet there.
std::vector<std::vector<Border>> borders(const WallPicture& picture) {
  std::vector<std::vector<Border>> out(picture.cut.faces.size());
  for (const auto& [edge, faces] : faces_of_edges(picture.cut)) {
    if (faces[1] < 0) continue;
    const WallCut::Face& a = picture.cut.faces[static_cast<std::size_t>(faces[0])];
    const WallCut::Face& b = picture.cut.faces[static_cast<std::size_t>(faces[1])];
    const bool of_section = a.section != b.section;
    if (!of_section &&
        picture.segment[static_cast<std::size_t>(a.tet)] == picture.segment[static_cast<std::size_t>(b.tet)])
      continue;
    for (const int f : faces) out[static_cast<std::size_t>(f)].push_back({edge, of_section});
  }
  return out;
}

std::string short_number(double value) {
  return number_text(std::round(10 * value) / 10);
}

struct Projection {
  polyaffine::Mat3 camera;
  Vec3 centre;
  double scale = 1;
  DrawPoint origin;
  std::string operator()(const Vec3& seen) const {
    return short_number(origin.x + scale * (seen.x() - centre.x())) + " " +
           short_number(origin.y - scale * (seen.y() - centre.y()));
  }
};

std::string shaded(const Rgb& colour, double facing, bool section) {
  const double light = section ? 1 : 0.62 + 0.38 * facing;
  return Rgb{light * colour.red, light * colour.green, light * colour.blue}.hex();
}

void draw_panel(Svg& svg, const WallPicture& picture, const WallPanel& panel, const Projection& project,
                const std::vector<std::vector<Border>>& border, const ColourRange& range) {
  const Points seen = project.camera * panel.positions;
  struct Visible {
    std::size_t face;
    double depth, facing;
  };
  std::vector<Visible> visible;
  for (std::size_t f = 0; f < picture.cut.faces.size(); ++f) {
    const auto& corners = picture.cut.faces[f].corners;
    Vec3 area = Vec3::Zero();
    double depth = 0;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vec3 here = seen.col(corners[k]), next = seen.col(corners[(k + 1) % corners.size()]);
      area += (here - seen.col(corners[0])).cross(next - seen.col(corners[0]));
      depth += here.z() / static_cast<double>(corners.size());
    }
    if (area.z() > 0) visible.push_back({f, depth, area.z() / area.norm()});
  }
  std::ranges::sort(visible, {}, &Visible::depth);
  for (const Visible& v : visible) {
    const WallCut::Face& face = picture.cut.faces[v.face];
    const int segment = picture.segment[static_cast<std::size_t>(face.tet)];
    const std::optional<double>& value = panel.values[static_cast<std::size_t>(segment - 1)];
    const Rgb colour = value && std::isfinite(*value) ? range.colour(*value) : Rgb{0.8, 0.8, 0.8};
    const std::string fill = shaded(colour, v.facing, face.section);
    std::string d;
    for (const int corner : face.corners) d += (d.empty() ? "M" : "L") + project(seen.col(corner));
    svg.path(d + "Z", "fill=\"" + fill + "\" stroke=\"" + fill + "\"");
    for (const Border& b : border[v.face])
      svg.path("M" + project(seen.col(b.edge.first)) + "L" + project(seen.col(b.edge.second)),
               b.of_section ? "stroke=\"#333333\" stroke-width=\"1.6\"" : "stroke=\"#777777\"");
  }
  const double middle = project.origin.x;
  svg.text({middle, 54}, panel.title, {16, "#222222", Anchor::middle, true});
  svg.text({middle, 75}, panel.note, {13, "#666666", Anchor::middle});
  svg.text({middle - kPanelWidth / 2 + 14, kTop + kHeight / 2}, picture.view.left,
           {13, "#555555", Anchor::middle, false, -90});
  svg.text({middle + kPanelWidth / 2 - 14, kTop + kHeight / 2}, picture.view.right,
           {13, "#555555", Anchor::middle, false, 90});
}

}  // namespace

std::string wall_picture_svg(const WallPicture& picture) {
  const polyaffine::Mat3 rows = camera(picture.view);
  Vec3 low = Vec3::Constant(INFINITY), high = -low;
  double least = INFINITY, most = -INFINITY;
  std::string description;
  for (const WallPanel& panel : picture.panels) {
    const Points seen = rows * panel.positions;
    if (seen.cols() > 0) {
      low = low.cwiseMin(seen.rowwise().minCoeff());
      high = high.cwiseMax(seen.rowwise().maxCoeff());
    }
    for (const auto& value : panel.values) {
      if (!value || !std::isfinite(*value)) continue;
      least = std::min(least, *value);
      most = std::max(most, *value);
    }
    description += (description.empty() ? "The wall cut open, " : ", ") + panel.title;
  }
  const Vec3 size = high - low;
  const double scale = std::min((kPanelWidth - 2 * kSide) / size.x(), kHeight / size.y());
  const ColourRange range = diverging_range(least, most);
  const double width = kPanelWidth * static_cast<double>(picture.panels.size());
  Svg svg(width, 640, picture.title, description);
  svg.text({width / 2, 24}, picture.title, {18, "#222222", Anchor::middle, true});
  const auto border = borders(picture);
  for (std::size_t i = 0; i < picture.panels.size(); ++i) {
    const double middle = kPanelWidth * (static_cast<double>(i) + 0.5);
    const Projection project{rows, (low + high) / 2, scale, {middle, kTop + kHeight / 2}};
    draw_panel(svg, picture, picture.panels[i], project, border, range);
  }
  draw_colour_bar(svg, {width / 2 - 180, 562}, 360, range,
                  {picture.unit, picture.low_meaning, picture.high_meaning});
  return svg.str();
}

}  // namespace cardiac
