#pragma once

#include <string>

#include <cardiac/report/colour_bar.hpp>

namespace cardiac {

enum class Quantity { longitudinal, circumferential, radial, activation };

/// How a quantity is coloured. One scale a quantity, whatever the values are, so that a colour means the same
/// in all pictures of a report and of all reports; what lies beyond is drawn in the last colour and marked.
struct Scale {
  ColourRange range;
  std::string unit, low_meaning, high_meaning;
  int decimals = 1;
};

/// Longitudinal and circumferential strain −30 to 30 %, radial strain −60 to 60 %: about 1.5 times the means
/// of healthy adults (−20, −23 and 34 to 44 %, Vo et al. 2018, JACC Cardiovasc. Imaging 11:196–205), the same
/// both ways. Activation 0 to 150 ms after the segment that is activated first: a normal wave takes 80 ms
/// (Durrer et al. 1970, Circulation 41:899–912), one with bundle branch block up to about 150 ms.
const Scale& scale_of(Quantity quantity);

/// Both ends in words, for beside a colour bar.
std::string scale_statement(const Scale& scale);

}  // namespace cardiac
