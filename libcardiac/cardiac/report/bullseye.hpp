#pragma once

#include <array>
#include <optional>
#include <string>

#include <cardiac/report/colour_bar.hpp>
#include <cardiac/report/svg.hpp>

namespace cardiac {

/// Where a segment lies in the bull's-eye: radii as fractions of the outer one, angles in degrees
/// counter-clockwise from the right; anterior is at the top, the septum left, the apex (17) in the middle
/// (Cerqueira et al. 2002, Circulation 105:539–542).
struct BullseyeCell {
  double inner = 0, outer = 0;
  double from_deg = 0, to_deg = 0;
  /// The middle of the cell in the unit disc, y upwards.
  DrawPoint centre() const;
};

/// `segment` 1–17; throws std::out_of_range otherwise.
BullseyeCell bullseye_cell(int segment);

struct Bullseye {
  std::string title, unit;
  ColourScale scale = ColourScale::diverging;
  std::string low_meaning, high_meaning;  ///< what the ends of the colour bar mean
  int decimals = 1;
  std::array<std::optional<double>, 17> values;  ///< of segments 1–17; what is missing is drawn grey
};

/// The bull's-eye as SVG: each cell coloured, with its number and value, and a colour bar with the unit.
std::string bullseye_svg(const Bullseye& bullseye);

}  // namespace cardiac
