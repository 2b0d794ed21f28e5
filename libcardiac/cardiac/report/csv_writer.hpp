#pragma once

#include <concepts>
#include <string>
#include <string_view>

namespace cardiac {

/// Writes the text of a CSV table (RFC 4180, lines end with \n): the header, then the fields of each row with
/// << and end_row().
class CsvWriter {
 public:
  /// `header`: the names of the columns, with commas between them; it is taken as it is. `digits`:
  /// significant ones of the numbers.
  explicit CsvWriter(std::string_view header, int digits = 9);

  /// Text, in quotes where a comma, a quote or a line end in it asks for them.
  CsvWriter& operator<<(std::string_view field);
  CsvWriter& operator<<(const char* field) { return *this << std::string_view(field); }
  CsvWriter& operator<<(const std::string& field) { return *this << std::string_view(field); }
  /// A number as number_text; empty where it is not finite.
  CsvWriter& operator<<(double value);
  CsvWriter& operator<<(std::integral auto value) { return *this << std::string_view(std::to_string(value)); }
  /// Text that is always in quotes.
  CsvWriter& quoted(std::string_view field);
  void end_row();

  const std::string& text() const { return text_; }

 private:
  void begin_field();

  int digits_;
  bool row_begun_ = false;
  std::string text_;
};

}  // namespace cardiac
