#pragma once

#include <cardiac/report/svg.hpp>

namespace cardiac {

/// An interval with ticks at round numbers (1, 2 or 5 times a power of ten apart).
struct Axis {
  double low = 0, high = 1, step = 1;
  std::vector<double> ticks() const;
  /// A tick's number with as many decimals as the step needs.
  std::string label(double tick) const;
};

/// The smallest axis with round ends that holds [low, high], about `intervals` ticks apart; an empty or
/// non-finite interval is widened to something that can be drawn.
Axis round_axis(double low, double high, int intervals);
/// Round ticks, but ends exactly at [low, high].
Axis tight_axis(double low, double high, int intervals);

/// A rectangle of a drawing with axes left and below.
struct Plot {
  double left = 0, top = 0, width = 1, height = 1;
  Axis x, y;
  DrawPoint at(double x_value, double y_value) const;
  /// Grid, frame, tick labels and axis titles.
  void draw(Svg& svg, std::string_view x_title, std::string_view y_title, double font_size) const;
};

}  // namespace cardiac
