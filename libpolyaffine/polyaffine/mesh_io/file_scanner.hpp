#pragma once

#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace polyaffine {

/// A file in memory, read from front to back as words, numbers, lines or raw bytes. Every failure is an
/// InputError that names file and line, what was found and what was expected.
class FileScanner {
 public:
  /// Text from `comment` to the end of its line is passed over ('\0': no comments).
  explicit FileScanner(std::filesystem::path file, char comment = '\0');

  const std::filesystem::path& file() const { return file_; }
  /// Nothing but white space and comments follows.
  bool at_end();
  /// The next word; `expected` is told when the file ends.
  std::string_view word(const char* expected);
  double real(const char* expected);
  long long integer(const char* expected);
  /// An integer in the same line, if one follows.
  std::optional<long long> integer_in_line();
  /// A number of items of which each takes at least `bytes` of what is left of the file.
  std::size_t count(const char* expected, std::size_t bytes);
  void check_count(long long count, const char* expected, std::size_t bytes) const;
  /// A vertex number from `first` to `first + size − 1`; returned from 0.
  int vertex(long long number, long long first, long long size) const;
  /// The rest of the line, without its end.
  std::string_view line();
  /// Bytes as they lie in the file.
  std::string_view bytes(std::size_t size, const char* expected);
  template <class T>
  T binary(const char* expected) {
    T value;
    std::memcpy(&value, bytes(sizeof value, expected).data(), sizeof value);
    return value;
  }
  /// Goes behind the next occurrence of a text; returned is what stands before it.
  std::string_view up_to(std::string_view text);
  std::size_t position() const { return position_; }
  /// Goes to a place, which a message then names.
  void go_to(std::size_t position) { position_ = last_ = position; }
  std::size_t size() const { return text_.size(); }
  std::string_view text() const { return text_; }

  [[noreturn]] void fail(const std::string& what) const;

 private:
  void skip_space();

  std::filesystem::path file_;
  char comment_;
  std::string text_;
  std::size_t position_ = 0, last_ = 0;  ///< start of the last item read, for messages
};

}  // namespace polyaffine
