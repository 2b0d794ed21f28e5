#include <cardiac/report/colour_map.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace cardiac {
namespace {

constexpr std::array<std::uint32_t, 11> kBlueWhiteRed{0x053061, 0x2166ac, 0x4393c3, 0x92c5de,
                                                      0xd1e5f0, 0xf7f7f7, 0xfddbc7, 0xf4a582,
                                                      0xd6604d, 0xb2182b, 0x67001f};
constexpr std::array<std::uint32_t, 9> kViridis{0x440154, 0x472d7b, 0x3b528b, 0x2c728e, 0x21918c,
                                                0x28ae80, 0x5ec962, 0xaddc30, 0xfde725};

Rgb from_hex(std::uint32_t code) {
  return {(code >> 16 & 0xff) / 255.0, (code >> 8 & 0xff) / 255.0, (code & 0xff) / 255.0};
}

template <size_t n>
Rgb interpolated(const std::array<std::uint32_t, n>& colours, double s) {
  const double place = std::clamp(s, 0.0, 1.0) * (n - 1);
  const size_t i = std::min(static_cast<size_t>(place), n - 2);
  const double t = place - static_cast<double>(i);
  const Rgb a = from_hex(colours[i]), b = from_hex(colours[i + 1]);
  return {a.red + t * (b.red - a.red), a.green + t * (b.green - a.green), a.blue + t * (b.blue - a.blue)};
}

double linear(double channel) {
  return channel <= 0.04045 ? channel / 12.92 : std::pow((channel + 0.055) / 1.055, 2.4);
}

}  // namespace

std::string Rgb::hex() const {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text = "#";
  for (const double channel : {red, green, blue}) {
    const auto byte = static_cast<size_t>(std::lround(255 * channel));
    text += kDigits[byte / 16];
    text += kDigits[byte % 16];
  }
  return text;
}

std::string Rgb::readable_text() const {
  const double luminance = 0.2126 * linear(red) + 0.7152 * linear(green) + 0.0722 * linear(blue);
  return luminance > 0.179 ? "#1a1a1a" : "#ffffff";
}

Rgb diverging_colour(double value) {
  return interpolated(kBlueWhiteRed, 0.5 + 0.5 * value);
}
Rgb sequential_colour(double value) {
  return interpolated(kViridis, value);
}

}  // namespace cardiac
