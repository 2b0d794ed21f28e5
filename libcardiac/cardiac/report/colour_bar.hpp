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
  Rgb colour(double value) const;
};

/// A diverging range with round ends, symmetric about 0, that holds [low, high].
ColourRange diverging_range(double low, double high);

struct ColourBarText {
  std::string unit, low_meaning, high_meaning;
};

/// A horizontal bar with ticks below, its unit right of it and what its ends mean under them.
void draw_colour_bar(Svg& svg, DrawPoint corner, double width, const ColourRange& range,
                     const ColourBarText& text);

}  // namespace cardiac
