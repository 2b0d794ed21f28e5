#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <cardiac/report/wall_cut.hpp>

namespace cardiac {

/// One state of the wall: where the corners of the cut are (3 × corners, mm) and the value of each segment.
struct WallPanel {
  std::string title, note;
  polyaffine::Points positions;
  std::vector<std::optional<double>> values;  ///< by segment; what is missing is drawn grey
};

/// A parallel projection: `towards_viewer` points out of the picture, `up` (not parallel to it) upwards.
struct WallView {
  polyaffine::Vec3 towards_viewer, up;
  std::string left, right;  ///< what lies on either side
};

struct WallPicture {
  std::string title, unit, low_meaning, high_meaning;
  WallCut cut;
  std::vector<int> segment;  ///< from 1, of each tet of the mesh that was cut
  WallView view;
  std::vector<WallPanel> panels;
};

/// The panels side by side at one scale, as SVG: faces coloured by the value of their segment and shaded by
/// how they are turned, borders of segments and of the section drawn darker, and a colour bar. Faces turned
/// away are left out, the others painted from the farthest to the nearest.
std::string wall_picture_svg(const WallPicture& picture);

}  // namespace cardiac
