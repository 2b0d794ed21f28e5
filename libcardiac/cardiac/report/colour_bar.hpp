#pragma once

#include <string>

#include <cardiac/report/axes.hpp>
#include <cardiac/report/colour_map.hpp>

namespace cardiac {

enum class ColourScale {
  diverging,  ///< blue below zero, red above, the same range both ways
  sequential  ///< dark for the least, bright for the most
};

/// Values and the colours they have: the low end of the axis is the first colour of the scale, its high end
/// the last.
struct ColourRange {
  Axis axis;
  ColourScale scale = ColourScale::diverging;
  /// Values beyond the ends have the colour of the end.
  Rgb colour(double value) const;
  /// −1 below the low end, 1 above the high one, otherwise 0.
  int beyond(double value) const;
};

struct ColourBarText {
  std::string unit, low_meaning, high_meaning;
};

/// A triangle `size` high and wide that points left (side −1) or right (1), its middle at `at`: the mark of a
/// value beyond the scale.
void draw_beyond_mark(Svg& svg, DrawPoint at, double size, int side, std::string_view colour);

/// A horizontal bar with ticks below, marks of what lies beyond at both ends, its unit right of it and what
/// its ends mean under them.
void draw_colour_bar(Svg& svg, DrawPoint corner, double width, const ColourRange& range,
                     const ColourBarText& text);

}  // namespace cardiac
