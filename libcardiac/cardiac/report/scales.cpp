#include <cardiac/report/scales.hpp>

#include <array>

#include <cardiac/report/text.hpp>

namespace cardiac {
namespace {

Scale strain_scale(double end, const std::string& low_meaning, const std::string& high_meaning) {
  return {{tight_axis(-end, end, 6), ColourScale::diverging}, "%", low_meaning, high_meaning, 1};
}

}  // namespace

const Scale& scale_of(Quantity quantity) {
  static const std::array<Scale, 4> scales{
      strain_scale(30, "shortening", "lengthening"), strain_scale(30, "shortening", "lengthening"),
      strain_scale(60, "thinning", "thickening"),
      Scale{{tight_axis(0, 150, 5), ColourScale::sequential}, "ms", "early", "late", 0}};
  return scales.at(static_cast<size_t>(quantity));
}

std::string scale_statement(const Scale& scale) {
  const Axis& axis = scale.range.axis;
  return "colours from " + axis.label(axis.low) + " to " + axis.label(axis.high) + " " + scale.unit +
         " in every report";
}

}  // namespace cardiac
