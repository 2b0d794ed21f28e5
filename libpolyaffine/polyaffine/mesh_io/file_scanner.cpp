#include "polyaffine/mesh_io/file_scanner.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <limits>
#include <sstream>
#include <utility>

#include <polyaffine/core/error.hpp>

namespace polyaffine {
namespace {

bool is_space(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

/// For messages: short and without bytes that a terminal would not show.
std::string shown(std::string_view word) {
  std::string out;
  for (const char c : word.substr(0, 30)) out += c >= ' ' && c <= '~' ? c : '?';
  return '"' + out + (word.size() > 30 ? "…\"" : "\"");
}

template <class T>
std::optional<T> number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  T value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error == std::errc() && end == word.data() + word.size()) return value;
  // A negative exponent beyond the range of doubles: the number is zero.
  if (error == std::errc::result_out_of_range && word.find('-', 1) != std::string_view::npos) return T(0);
  return std::nullopt;
}

}  // namespace

FileScanner::FileScanner(std::filesystem::path file, char comment)
    : file_(std::move(file)), comment_(comment) {
  if (!std::filesystem::is_regular_file(file_)) throw InputError(file_.string() + ": found no such file");
  std::ifstream stream(file_, std::ios::binary);
  text_.resize(std::filesystem::file_size(file_));
  stream.read(text_.data(), static_cast<std::streamsize>(text_.size()));
  if (!stream) throw InputError(file_.string() + ": cannot be read");
  if (text_.empty()) throw InputError(file_.string() + ": found an empty file, expected a mesh");
}

void FileScanner::fail(const std::string& what) const {
  const auto line = 1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(last_), '\n');
  throw InputError(file_.string() + ':' + std::to_string(line) + ": " + what);
}

void FileScanner::skip_space() {
  while (position_ < text_.size()) {
    if (comment_ != '\0' && text_[position_] == comment_) {
      position_ = std::min(text_.find('\n', position_), text_.size());
    } else if (is_space(text_[position_])) {
      ++position_;
    } else {
      break;
    }
  }
}

bool FileScanner::at_end() {
  skip_space();
  return position_ == text_.size();
}

std::string_view FileScanner::word(const char* expected) {
  skip_space();
  last_ = position_;
  if (position_ == text_.size())
    fail(std::string("found the end of the file, expected ") + expected + " (is the file cut off?)");
  while (position_ < text_.size() && !is_space(text_[position_])) ++position_;
  return std::string_view(text_).substr(last_, position_ - last_);
}

double FileScanner::real(const char* expected) {
  const std::string_view found = word(expected);
  if (const auto value = number<double>(found)) return *value;
  fail("found " + shown(found) + ", expected " + expected);
}

long long FileScanner::integer(const char* expected) {
  const std::string_view found = word(expected);
  if (const auto value = number<long long>(found)) return *value;
  fail("found " + shown(found) + ", expected " + expected);
}

std::optional<long long> FileScanner::integer_in_line() {
  while (position_ < text_.size() && (text_[position_] == ' ' || text_[position_] == '\t')) ++position_;
  if (position_ == text_.size() || is_space(text_[position_]) || text_[position_] == comment_)
    return std::nullopt;
  return integer("a whole number");
}

std::size_t FileScanner::count(const char* expected, std::size_t bytes) {
  const long long found = integer(expected);
  check_count(found, expected, bytes);
  return static_cast<std::size_t>(found);
}

void FileScanner::check_count(long long count, const char* expected, std::size_t bytes) const {
  const std::size_t left = text_.size() - position_;
  if (count < 0 || static_cast<std::size_t>(count) > left / bytes + 1 ||
      count > std::numeric_limits<int>::max() / 4)
    fail("found the number " + std::to_string(count) + ", expected " + expected +
         " that fits the rest of the file (" + std::to_string(left) + " bytes; is the file cut off?)");
}

int FileScanner::vertex(long long number, long long first, long long size) const {
  if (number < first || number >= first + size)
    fail("found the point " + std::to_string(number) + ", expected " + std::to_string(first) + " to " +
         std::to_string(first + size - 1));
  return static_cast<int>(number - first);
}

std::string_view FileScanner::line() {
  last_ = position_;
  const std::size_t end = std::min(text_.find('\n', position_), text_.size());
  std::string_view out = std::string_view(text_).substr(position_, end - position_);
  position_ = std::min(end + 1, text_.size());
  if (out.ends_with('\r')) out.remove_suffix(1);
  return out;
}

std::string_view FileScanner::bytes(std::size_t size, const char* expected) {
  last_ = position_;
  if (text_.size() - position_ < size)
    fail(std::string("found the end of the file, expected ") + expected + " (is the file cut off?)");
  position_ += size;
  return std::string_view(text_).substr(last_, size);
}

std::string_view FileScanner::up_to(std::string_view text) {
  last_ = position_;
  const std::size_t at = text_.find(text, position_);
  if (at == std::string::npos)
    fail("found the end of the file, expected " + std::string(text) + " (is the file cut off?)");
  position_ = at + text.size();
  return std::string_view(text_).substr(last_, at - last_);
}

}  // namespace polyaffine
