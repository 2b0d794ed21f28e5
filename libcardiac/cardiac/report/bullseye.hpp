#pragma once

#include <map>
#include <string>
#include <vector>

#include <cardiac/report/bullseye_cells.hpp>
#include <cardiac/report/scales.hpp>

namespace cardiac {

/// Segments that the protocol treats otherwise than the rest.
struct NamedRegion {
  std::string name;
  std::vector<int> segments;
};

/// How the region of this index is lettered: A, B, …
char region_letter(size_t index);

struct Bullseye {
  std::string title;
  std::string note;  ///< under the title: the instant, the reference
  Quantity quantity = Quantity::longitudinal;
  std::map<int, double> values;  ///< by segment; what is missing or not finite is drawn grey
  std::vector<NamedRegion> regions;
};

/// The bull's-eye as SVG: segments 1–17, each coloured by the scale of its quantity, with its number and
/// value and a triangle where the value is beyond the scale; regions outlined, lettered and named below; a
/// colour bar with the unit and the scale in words. Numbers and values keep clear of the borders of cells.
std::string bullseye_svg(const Bullseye& bullseye);

/// The same of the right free wall, segments 18–29 in right_wall_cell.
std::string right_wall_svg(const Bullseye& bullseye);

/// Where the unit disc of the cells lies in the drawings.
BullseyeDisc bullseye_disc();
BullseyeDisc right_wall_disc();

}  // namespace cardiac
