#include <cardiac/report/segment_picture.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include <Eigen/Geometry>
#include <cardiac/anatomy/idealised.hpp>
#include <cardiac/anatomy/segments.hpp>
#include <cardiac/report/wall_drawing.hpp>

namespace cardiac {

using polyaffine::Points;
using polyaffine::Vec3;

namespace {

constexpr double kPanelWidth = 340, kTop = 84, kHeight = 290, kSide = 40;

// Hue in turns, saturation and lightness from 0 to 1.
Rgb from_hsl(double hue, double saturation, double lightness) {
  const auto channel = [&](double shift) {
    const double k = std::fmod(shift + 12 * hue, 12.0);
    return lightness -
           saturation * std::min(lightness, 1 - lightness) * std::max(-1.0, std::min({k - 3, 9 - k, 1.0}));
  };
  return {channel(0), channel(8), channel(4)};
}

// The face of each segment that is nearest to the middle of what is seen of it, and how much that is.
struct Place {
  Vec3 sum = Vec3::Zero(), at = Vec3::Zero();
  double area = 0, distance = std::numeric_limits<double>::infinity();
};

// Of the faces that `counts` says.
std::map<int, Place> label_places(const WallScene& scene,
                                  const std::function<bool(const WallCut::Face&)>& counts) {
  const Points seen = scene.camera * scene.positions;
  std::map<int, Place> out;
  for (const bool choose : {false, true})
    for (const WallCut::Face& face : scene.cut.faces) {
      if (!counts(face)) continue;
      Vec3 middle = Vec3::Zero(), normal = Vec3::Zero();
      for (std::size_t k = 0; k < face.corners.size(); ++k) {
        const Vec3 here = seen.col(face.corners[k]);
        middle += here / static_cast<double>(face.corners.size());
        normal +=
            (here - seen.col(face.corners[0]))
                .cross(seen.col(face.corners[(k + 1) % face.corners.size()]) - seen.col(face.corners[0]));
      }
      if (normal.z() <= 0) continue;
      Place& place = out[scene.segment[face.tet]];
      if (!choose) {
        place.sum += normal.z() * middle;
        place.area += normal.z();
      } else if (const double d = (middle - place.sum / place.area).head<2>().norm(); d < place.distance) {
        place.distance = d;
        place.at = middle;
      }
    }
  return out;
}

struct Panel {
  std::string title;
  WallCut cut;
  WallView view;
  bool across;  ///< numbers on the section, not on the epicardium
};

void draw_panel(Svg& svg, const Panel& panel, const polyaffine::TetMesh& mesh,
                const std::vector<int>& segment, double scale, double middle) {
  const WallScene scene{panel.cut, segment, panel.view.camera(), panel.cut.positions(mesh.points()),
                        segment_colour};
  const Points seen = scene.camera * scene.positions;
  const WallPlacement place{
      (seen.rowwise().minCoeff() + seen.rowwise().maxCoeff()) / 2, scale, {middle, kTop + kHeight / 2}};
  draw_wall(svg, scene, place);
  constexpr double kLeastArea = 60;  // mm², twice what is seen of a segment that gets its number
  const std::vector<int> outside = mesh.surface_points({kEpicardium});
  const auto counts = [&](const WallCut::Face& face) {
    return panel.across ? face.section : std::ranges::all_of(face.corners, [&](int corner) {
      return std::ranges::binary_search(outside, panel.cut.corners[corner].from);
    });
  };
  for (const auto& [number, label] : label_places(scene, counts)) {
    if (label.area < kLeastArea) continue;
    const DrawPoint at = place(label.at);
    svg.text({at.x, at.y + 5}, std::to_string(number), {14, "#111111", Anchor::middle, true});
  }
  svg.text({middle, 58}, panel.title, {15, "#222222", Anchor::middle, true});
  svg.text({middle - kPanelWidth / 2 + 14, kTop + kHeight / 2}, panel.view.left,
           {13, "#555555", Anchor::middle, false, -90});
  svg.text({middle + kPanelWidth / 2 - 14, kTop + kHeight / 2}, panel.view.right,
           {13, "#555555", Anchor::middle, false, 90});
}

}  // namespace

Rgb segment_colour(int segment) {
  constexpr double kSaturation = 0.6;
  if (segment == kAhaSegments) return from_hsl(0.6, 0.15, 0.8);
  if (segment < kAhaSegments) {
    const double turn = aha_centre_angle(segment) / (2 * polyaffine::kPi);
    const double hue = 0.62 + 0.26 * std::sin(2 * polyaffine::kPi * turn + 0.4);
    return from_hsl(hue, kSaturation, 0.78 - 0.05 * aha_ring(segment) + (segment % 2 == 0 ? 0.06 : 0.0));
  }
  const int k = segment - kAhaSegments - 1;
  return from_hsl(0.02 + 0.05 * (k % 4), kSaturation, 0.62 + 0.05 * (k / 4) + (k % 2 == 0 ? 0.05 : 0.0));
}

std::string segment_picture_svg(const polyaffine::TetMesh& mesh, const VentricularCoordinates& coordinates,
                                const std::vector<int>& segment) {
  const Vec3 axis = coordinates.axis(), front = coordinates.anterior();
  const Vec3 beyond = coordinates.base_centre() + 1e3 * coordinates.cavity_length() * axis;
  const Vec3 half = coordinates.base_centre() - 0.5 * coordinates.cavity_length() * axis;
  const std::string septal = coordinates.right() ? "right ventricle" : "septum", lateral = "lateral wall";
  const std::vector<Panel> panels{
      {"anterior", cut_wall(mesh, beyond, axis), {front + 0.2 * axis, axis, septal, lateral}, false},
      {"inferior", cut_wall(mesh, beyond, axis), {0.2 * axis - front, axis, lateral, septal}, false},
      {"cut across, from the apex", cut_wall(mesh, half, -axis), {-axis, front, septal, lateral}, true}};
  double scale = std::numeric_limits<double>::infinity();
  for (const Panel& panel : panels) {
    const Points seen = panel.view.camera() * panel.cut.positions(mesh.points());
    const Vec3 size = seen.rowwise().maxCoeff() - seen.rowwise().minCoeff();
    scale = std::min({scale, (kPanelWidth - 2 * kSide) / size.x(), kHeight / size.y()});
  }
  const double width = kPanelWidth * static_cast<double>(panels.size());
  Svg svg(width, kTop + kHeight + 20, "AHA segments", "The segments of the wall from three sides");
  svg.text({width / 2, 26}, "AHA segments of the wall", {18, "#222222", Anchor::middle, true});
  for (std::size_t i = 0; i < panels.size(); ++i)
    draw_panel(svg, panels[i], mesh, segment, scale, kPanelWidth * (static_cast<double>(i) + 0.5));
  return svg.str();
}

}  // namespace cardiac
