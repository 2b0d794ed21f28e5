#include <cardiac/report/svg.hpp>

#include <cmath>
#include <numbers>

#include <cardiac/report/text.hpp>

namespace cardiac {
namespace {

std::string point_text(DrawPoint p) {
  return coordinate(p.x) + "," + coordinate(p.y);
}

std::string attribute(std::string_view name, double value) {
  return " " + std::string(name) + "=\"" + coordinate(value) + "\"";
}

std::string closed(std::string_view element, std::string_view tooltip) {
  if (tooltip.empty()) return "/>\n";
  return "><title>" + escape_markup(tooltip) + "</title></" + std::string(element) + ">\n";
}

/// Width in em of a character that begins with this byte; 0 inside of a UTF-8 sequence.
double em_width(unsigned char c) {
  constexpr std::string_view kNarrow = "ijl.,:;'!|", kSlim = " ftr()[]-/I";
  if ((c & 0xC0) == 0x80) return 0;
  if (c >= 0x80) return c >= 0xE2 ? 0.6 : 0.56;  // minus and dashes; accented letters
  if (kNarrow.find(static_cast<char>(c)) != std::string_view::npos) return 0.28;
  if (kSlim.find(static_cast<char>(c)) != std::string_view::npos) return 0.34;
  if (c == 'm' || c == 'M' || c == 'w' || c == 'W' || c == '%') return 0.95;
  return c >= 'A' && c <= 'Z' ? 0.75 : 0.56;
}

std::string_view anchor_name(Anchor anchor) {
  return anchor == Anchor::start ? "start" : anchor == Anchor::middle ? "middle" : "end";
}

}  // namespace

std::string coordinate(double value) {
  return number_text(std::round(100 * value) / 100);
}

double text_width(std::string_view content, double size, bool bold) {
  constexpr double kBold = 1.08;
  double width = 0;
  for (const char c : content) width += em_width(static_cast<unsigned char>(c));
  return width * size * (bold ? kBold : 1);
}

Svg::Svg(double width, double height, std::string_view title, std::string_view description)
    : body_("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + coordinate(width) + " " +
            coordinate(height) + "\"" + attribute("width", width) + attribute("height", height) +
            " role=\"img\" aria-label=\"" +
            escape_markup(std::string(title) + ". " + std::string(description)) +
            "\" font-family=\"Helvetica, Arial, 'Liberation Sans', sans-serif\">\n<title>" +
            escape_markup(title) + "</title>\n<desc>" + escape_markup(description) + "</desc>\n" +
            "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n") {}

void Svg::line(DrawPoint from, DrawPoint to, std::string_view style) {
  body_ += "<line" + attribute("x1", from.x) + attribute("y1", from.y) + attribute("x2", to.x) +
           attribute("y2", to.y) + " " + std::string(style) + "/>\n";
}

void Svg::polyline(const std::vector<DrawPoint>& points, std::string_view style, std::string_view tooltip) {
  body_ += "<polyline fill=\"none\" points=\"";
  for (const DrawPoint& p : points) body_ += point_text(p) + " ";
  if (!points.empty()) body_.pop_back();
  body_ += "\" " + std::string(style) + closed("polyline", tooltip);
}

void Svg::path(std::string_view d, std::string_view style, std::string_view tooltip) {
  body_ += "<path d=\"" + std::string(d) + "\" " + std::string(style) + closed("path", tooltip);
}

void Svg::circle(DrawPoint centre, double radius, std::string_view style, std::string_view tooltip) {
  body_ += "<circle" + attribute("cx", centre.x) + attribute("cy", centre.y) + attribute("r", radius) + " " +
           std::string(style) + closed("circle", tooltip);
}

void Svg::rect(DrawPoint corner, double width, double height, std::string_view style) {
  body_ += "<rect" + attribute("x", corner.x) + attribute("y", corner.y) + attribute("width", width) +
           attribute("height", height) + " " + std::string(style) + "/>\n";
}

void Svg::text(DrawPoint at, std::string_view content, const TextStyle& style) {
  constexpr double kHalfCapital = 0.36;
  const DrawPoint shift = {-std::sin(style.rotate_deg * std::numbers::pi / 180) * kHalfCapital * style.size,
                           std::cos(style.rotate_deg * std::numbers::pi / 180) * kHalfCapital * style.size};
  const DrawPoint p = {at.x + shift.x, at.y + shift.y};
  body_ += "<text" + attribute("x", p.x) + attribute("y", p.y) + attribute("font-size", style.size) +
           " text-anchor=\"" + std::string(anchor_name(style.anchor)) + "\" fill=\"" + style.colour + "\"";
  if (style.bold) body_ += " font-weight=\"bold\"";
  if (style.rotate_deg != 0)
    body_ += " transform=\"rotate(" + coordinate(style.rotate_deg) + " " + coordinate(p.x) + " " +
             coordinate(p.y) + ")\"";
  body_ += ">" + escape_markup(content) + "</text>\n";
}

}  // namespace cardiac
