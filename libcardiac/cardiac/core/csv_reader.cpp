#include <cardiac/core/csv_reader.hpp>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>
#include <limits>

#include <polyaffine/core/error.hpp>

namespace cardiac {
namespace {

using polyaffine::InputError;

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields(1);
  bool inside_quotes = false;
  for (size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"' && inside_quotes && i + 1 < line.size() && line[i + 1] == '"') {
      fields.back() += line[++i];
    } else if (c == '"') {
      inside_quotes = !inside_quotes;
    } else if (c == ',' && !inside_quotes) {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  return fields;
}

template <class Number>
bool parse(const std::string& text, Number& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

}  // namespace

std::string read_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file)) {
    const bool there = std::filesystem::exists(file);
    throw InputError(file.string() + (there ? ": cannot be read" : ": no such file"));
  }
  return {std::istreambuf_iterator<char>(stream), {}};
}

CsvTable::CsvTable(const std::filesystem::path& file) : file_(file.string()) {
  const std::string text = read_text(file);
  int line_number = 0;
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    std::string line = text.substr(begin, end - begin);
    begin = end + 1;
    ++line_number;
    if (line.ends_with('\r')) line.pop_back();
    std::vector<std::string> fields = split(line);
    if (line_number == 1) {
      header_ = std::move(fields);
    } else if (fields.size() == header_.size()) {
      rows_.push_back({line_number, std::move(fields)});
    } else {
      throw InputError(file_ + ":" + std::to_string(line_number) + ": found " +
                       std::to_string(fields.size()) + " fields, expected " + std::to_string(header_.size()) +
                       " as in the header");
    }
  }
  if (header_.empty()) throw InputError(file_ + ": is empty, expected a header row");
}

size_t CsvTable::column(const std::string& name) const {
  const auto found = std::ranges::find(header_, name);
  if (found == header_.end()) throw InputError(file_ + ":1: the column '" + name + "' is missing");
  return static_cast<size_t>(found - header_.begin());
}

double CsvTable::number(size_t row, size_t column) const {
  double value = std::numeric_limits<double>::quiet_NaN();
  if (!text(row, column).empty() && !parse(text(row, column), value)) fail(row, column, "a number");
  return value;
}

int CsvTable::integer(size_t row, size_t column) const {
  int value = 0;
  if (!parse(text(row, column), value)) fail(row, column, "an integer");
  return value;
}

void CsvTable::fail(size_t row, size_t column, const std::string& expected) const {
  throw InputError(file_ + ":" + std::to_string(rows_[row].line) + ", column '" + header_[column] +
                   "': found '" + text(row, column) + "', expected " + expected);
}

}  // namespace cardiac
