#pragma once

#include <string>
#include <string_view>

namespace cardiac {

/// A number for files: at most so many significant digits, a point as decimal sign in every locale, "" where
/// it is not finite.
std::string number_text(double value, int digits = 9);

/// The shortest text that reads back as the same number, for what is computed with; "" where it is not
/// finite.
std::string exact_text(double value);

/// `value` rounded to the 9 significant digits that number_text shows.
double rounded_for_files(double value);

/// A number for people: `decimals` digits after the point, a real minus sign, "–" where it is not finite.
std::string display_text(double value, int decimals);

/// Text for XML and HTML content and attributes: & < > " ' escaped, control characters that XML forbids
/// replaced by a space, bytes that are not UTF-8 by U+FFFD.
std::string escape_markup(std::string_view text);

}  // namespace cardiac
