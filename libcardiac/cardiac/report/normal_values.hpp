#pragma once

#include <string>
#include <vector>

namespace cardiac {

/// What one source says of healthy adults: a range, or a mean with its 95 % confidence interval.
struct PublishedValue {
  std::string text;    ///< numbers, without the unit
  std::string source;  ///< method, people, authors
};

/// A quantity of the page and what is published of it.
struct NormalValue {
  std::string name, unit;
  double low = 0, high = 0;  ///< the span of what is published; NaN where that is one number
  std::vector<PublishedValue> published;
  bool strain = false;

  /// "50 to 70"; what is published where there is no span.
  std::string range() const;
  /// Where a value lies: "within", "lower" or "higher", of a strain "weaker" or "stronger" instead; empty
  /// where value or span is not finite.
  std::string place_of(double value) const;
};

enum class Measured {
  lv_edv,
  lv_esv,
  lv_ef,
  lv_peak_pressure,
  rv_ef,
  rv_peak_pressure,
  gls,
  gcs,
  grs,
  twist,
  rv_gls
};
const NormalValue& normal_value(Measured quantity);

}  // namespace cardiac
