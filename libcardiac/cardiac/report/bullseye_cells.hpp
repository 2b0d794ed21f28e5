#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include <cardiac/report/svg.hpp>

namespace cardiac {

/// Where a segment lies in the bull's-eye: radii as fractions of the outer one, angles in degrees
/// counter-clockwise from the right; anterior is at the top, the septum left, the apex (17) in the middle
/// (Cerqueira et al. 2002, Circulation 105:539–542).
struct BullseyeCell {
  double inner = 0, outer = 0;
  double from_deg = 0, to_deg = 0;
  /// A point well inside the cell, in the unit disc, y upwards: the middle of a ring's cell, the centroid of
  /// one that reaches the centre.
  DrawPoint centre() const;
  /// In the unit disc; the border belongs to the cell.
  bool holds(double radius, double angle_deg) const;
};

/// `segment` 1–17; throws std::out_of_range otherwise.
BullseyeCell bullseye_cell(int segment);

/// Place of a segment of the right free wall (18–29), unrolled to the left half of a disc beside the septum:
/// anterior at the top, inferior at the bottom, the base outside and the apex (29) at the middle of the
/// straight side. Throws std::out_of_range for other segments.
BullseyeCell right_wall_cell(int segment);

/// Cells that are drawn together, by segment.
using BullseyeCells = std::map<int, BullseyeCell>;
BullseyeCells left_cells();
BullseyeCells right_cells();

/// The unit disc in a drawing.
struct BullseyeDisc {
  DrawPoint centre;
  double radius = 1;
  DrawPoint at(double r, double angle_deg) const;
  DrawPoint at(DrawPoint in_unit_disc) const;
};

/// Path of the border of a cell.
std::string cell_path(const BullseyeDisc& disc, const BullseyeCell& cell);

/// Path of the border of several segments taken as one: the sides that no two of them share.
std::string outline_path(const BullseyeDisc& disc, const BullseyeCells& cells,
                         const std::vector<int>& segments);

}  // namespace cardiac
