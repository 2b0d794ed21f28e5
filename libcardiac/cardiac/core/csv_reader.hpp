#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace cardiac {

/// The whole text of a file. Throws InputError naming a file that is missing or cannot be read.
std::string read_text(const std::filesystem::path& file);

/// A CSV table with a header row, RFC 4180 quotes, strict about its columns: those named are looked up by
/// name, further ones are ignored. Every error is an InputError with file, line and column.
class CsvTable {
 public:
  explicit CsvTable(const std::filesystem::path& file);

  size_t rows() const { return rows_.size(); }
  const std::vector<std::string>& columns() const { return header_; }
  /// Index of a column, for the calls below.
  size_t column(const std::string& name) const;
  const std::string& text(size_t row, size_t column) const { return rows_[row].fields[column]; }
  /// A number, NaN for an empty field.
  double number(size_t row, size_t column) const;
  int integer(size_t row, size_t column) const;
  /// Throws the InputError "file:line, column 'name': found …, expected …".
  [[noreturn]] void fail(size_t row, size_t column, const std::string& expected) const;

 private:
  struct Row {
    int line = 0;
    std::vector<std::string> fields;
  };
  std::string file_;
  std::vector<std::string> header_;
  std::vector<Row> rows_;
};

}  // namespace cardiac
