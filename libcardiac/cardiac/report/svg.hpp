#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace cardiac {

/// A point of a drawing in its user units, y downwards.
struct DrawPoint {
  double x = 0, y = 0;
};

enum class Anchor { start, middle, end };

struct TextStyle {
  double size = 14;
  std::string colour = "#222222";
  Anchor anchor = Anchor::start;
  bool bold = false;
  double rotate_deg = 0;  ///< about the anchor point, clockwise
};

/// A drawing under construction. `style` arguments are SVG attributes as they stand (`stroke="#333333"`);
/// every text (contents, titles, tooltips) is escaped here.
class Svg {
 public:
  /// `title` and `description` are what a screen reader says.
  Svg(double width, double height, std::string_view title, std::string_view description);

  void line(DrawPoint from, DrawPoint to, std::string_view style);
  void polyline(const std::vector<DrawPoint>& points, std::string_view style, std::string_view tooltip = {});
  /// A path's `d` as it stands.
  void path(std::string_view d, std::string_view style, std::string_view tooltip = {});
  void circle(DrawPoint centre, double radius, std::string_view style, std::string_view tooltip = {});
  void rect(DrawPoint corner, double width, double height, std::string_view style);
  /// `at` is on the anchor, half the height of a capital letter below its middle: vertically centred.
  void text(DrawPoint at, std::string_view content, const TextStyle& style = {});

  /// The whole file, without an XML declaration, so that it can stand inside HTML as well.
  std::string str() const { return body_ + "</svg>\n"; }

 private:
  std::string body_;
};

/// Width of a text in a drawing's font, an estimate from Helvetica's metrics that is not too small.
double text_width(std::string_view content, double size, bool bold);

/// A coordinate for SVG attributes: two decimals, whatever the locale.
std::string coordinate(double value);

}  // namespace cardiac
