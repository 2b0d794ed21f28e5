#pragma once

#include <optional>
#include <string>
#include <vector>

#include <cardiac/report/scales.hpp>
#include <cardiac/report/wall_drawing.hpp>

namespace cardiac {

/// One state of the wall: where the corners of the cut are (3 × corners, mm) and the value of each segment.
struct WallPanel {
  std::string title, note;
  polyaffine::Points positions;
  std::vector<std::optional<double>> values;  ///< by segment; what is missing is drawn grey
};

struct WallPicture {
  std::string title;
  Quantity quantity = Quantity::circumferential;
  WallCut cut;
  std::vector<int> segment;  ///< from 1, of each tet of the mesh that was cut
  WallView view;
  std::vector<WallPanel> panels;
};

/// The panels side by side at one scale, as SVG: walls (draw_wall) coloured by the value of their segments on
/// the scale of the quantity, and a colour bar.
std::string wall_picture_svg(const WallPicture& picture);

}  // namespace cardiac
