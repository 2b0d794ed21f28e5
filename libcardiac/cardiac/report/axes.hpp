#pragma once

#include <cardiac/report/svg.hpp>

namespace cardiac {

/// An interval with ticks at round numbers: 1, 2 or 5 times a power of ten apart, or on a logarithmic scale
/// at powers of ten and, within two decades, at 2 and 5 times them.
struct Axis {
  double low = 0, high = 1, step = 1;
  bool logarithmic = false;  ///< low > 0; `step` plays no part
  std::vector<double> ticks() const;
  /// A tick's number with as many decimals as the step needs.
  std::string label(double tick) const;
  /// Place of a value on the axis, 0 at low and 1 at high.
  double fraction(double value) const;
};

/// The smallest axis with round ends that holds [low, high], about `intervals` ticks apart; an empty or
/// non-finite interval is widened to something that can be drawn.
Axis round_axis(double low, double high, int intervals);
/// Round ticks, but ends exactly at [low, high].
Axis tight_axis(double low, double high, int intervals);
/// The smallest logarithmic axis that holds [low, high] with a margin and ends at 1, 2 or 5 times a power of
/// ten; something that can be drawn when the numbers are not positive or finite.
Axis log_axis(double low, double high);

/// A rectangle of a drawing with axes left and below.
struct Plot {
  double left = 0, top = 0, width = 1, height = 1;
  Axis x, y;
  DrawPoint at(double x_value, double y_value) const;
  /// Grid, frame, tick labels (those of y only when asked for) and axis titles.
  void draw(Svg& svg, std::string_view x_title, std::string_view y_title, double font_size,
            bool y_labels = true) const;
};

}  // namespace cardiac
