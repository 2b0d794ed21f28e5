#include <cardiac/report/wall_drawing.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <cardiac/report/text.hpp>

namespace cardiac {

using polyaffine::Points;
using polyaffine::Vec3;

namespace {

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
std::vector<std::vector<Border>> borders(const WallScene& scene) {
  std::vector<std::vector<Border>> out(scene.cut.faces.size());
  for (const auto& [edge, faces] : faces_of_edges(scene.cut)) {
    if (faces[1] < 0) continue;
    const WallCut::Face& a = scene.cut.faces[static_cast<std::size_t>(faces[0])];
    const WallCut::Face& b = scene.cut.faces[static_cast<std::size_t>(faces[1])];
    const bool of_section = a.section != b.section;
    if (!of_section &&
        scene.segment[static_cast<std::size_t>(a.tet)] == scene.segment[static_cast<std::size_t>(b.tet)])
      continue;
    for (const int f : faces) out[static_cast<std::size_t>(f)].push_back({edge, of_section});
  }
  return out;
}

std::string short_number(double value) {
  return number_text(std::round(10 * value) / 10);
}

std::string text_of(const WallPlacement& place, const Vec3& seen) {
  const DrawPoint at = place(seen);
  return short_number(at.x) + " " + short_number(at.y);
}

std::string shaded(const Rgb& colour, double facing, bool section) {
  const double light = section ? 1 : 0.62 + 0.38 * facing;
  return Rgb{light * colour.red, light * colour.green, light * colour.blue}.hex();
}

}  // namespace

polyaffine::Mat3 WallView::camera() const {
  const Vec3 front = towards_viewer.normalized();
  const Vec3 to_right = up.cross(front).normalized();
  polyaffine::Mat3 rows;
  rows << to_right.transpose(), front.cross(to_right).transpose(), front.transpose();
  return rows;
}

DrawPoint WallPlacement::operator()(const Vec3& seen) const {
  return {origin.x + scale * (seen.x() - centre.x()), origin.y - scale * (seen.y() - centre.y())};
}

void draw_wall(Svg& svg, const WallScene& scene, const WallPlacement& place) {
  const auto border = borders(scene);
  const Points seen = scene.camera * scene.positions;
  struct Visible {
    std::size_t face;
    double depth, facing;
  };
  std::vector<Visible> visible;
  for (std::size_t f = 0; f < scene.cut.faces.size(); ++f) {
    const auto& corners = scene.cut.faces[f].corners;
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
    const WallCut::Face& face = scene.cut.faces[v.face];
    const int segment = scene.segment[static_cast<std::size_t>(face.tet)];
    const std::string fill = shaded(scene.colour(segment), v.facing, face.section);
    std::string d;
    for (const int corner : face.corners) d += (d.empty() ? "M" : "L") + text_of(place, seen.col(corner));
    svg.path(d + "Z", "fill=\"" + fill + "\" stroke=\"" + fill + "\"");
    for (const Border& b : border[v.face])
      svg.path("M" + text_of(place, seen.col(b.edge.first)) + "L" + text_of(place, seen.col(b.edge.second)),
               b.of_section ? "stroke=\"#333333\" stroke-width=\"1.6\"" : "stroke=\"#777777\"");
  }
}

}  // namespace cardiac
