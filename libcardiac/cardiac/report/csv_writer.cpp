#include "cardiac/report/csv_writer.hpp"

#include <cardiac/report/text.hpp>

namespace cardiac {

CsvWriter::CsvWriter(std::string_view header, int digits) : digits_(digits), text_(header) {
  text_ += '\n';
}

CsvWriter& CsvWriter::operator<<(std::string_view field) {
  if (field.find_first_of(",\"\r\n") != std::string_view::npos) return quoted(field);
  begin_field();
  text_ += field;
  return *this;
}

CsvWriter& CsvWriter::operator<<(double value) {
  return *this << std::string_view(number_text(value, digits_));
}

CsvWriter& CsvWriter::quoted(std::string_view field) {
  begin_field();
  text_ += '"';
  for (const char c : field) {
    if (c == '"') text_ += c;
    text_ += c;
  }
  text_ += '"';
  return *this;
}

void CsvWriter::end_row() {
  text_ += '\n';
  row_begun_ = false;
}

void CsvWriter::begin_field() {
  if (row_begun_) text_ += ',';
  row_begun_ = true;
}

}  // namespace cardiac
