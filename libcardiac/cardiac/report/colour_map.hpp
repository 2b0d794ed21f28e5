#pragma once

#include <string>

namespace cardiac {

struct Rgb {
  double red = 0, green = 0, blue = 0;  ///< 0–1
  std::string hex() const;
  /// Black or near-white, whichever is easier to read on this colour (WCAG relative luminance).
  std::string readable_text() const;
};

/// Blue (−1) over white (0) to red (+1): ColorBrewer RdBu, safe for the colour-blind. Values beyond are
/// clamped.
Rgb diverging_colour(double value);
/// Dark (0) to bright (1) with growing lightness: viridis (Smith & van der Walt 2015).
Rgb sequential_colour(double value);

}  // namespace cardiac
