#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <typeindex>
#include <utility>
#include <vector>

#include <polyaffine/core/archive_access.hpp>

namespace polyaffine {

/// What a file holds; a reader accepts the same name and version only.
struct ArchiveFormat {
  std::string name;
  std::uint32_t version = 1;
};

/// Writes values as bytes: integers and IEEE numbers little-endian at the width of their type, sequences
/// after their length. archive_types.hpp and archive_eigen.hpp have the types that are known; a new one lists
/// its members once, for both directions, by a function beside it (or as a member: ArchiveAccess):
///
///   template <class Archive>
///   void archive(Archive& a, Shape& x) { a(x.name, x.points); }
///
/// and, where `Archive::kReading`, refuses by `a.refuse` what no writer makes. The members must be visited in
/// the same order both ways.
class ArchiveWriter {
 public:
  static constexpr bool kReading = false;

  template <class... T>
  void operator()(const T&... values);
  /// A named part with its length, whose bytes `content` writes.
  template <class Content>
  void section(std::string_view name, const Content& content);

  void bytes(const void* data, std::size_t size) { bytes_.append(static_cast<const char*>(data), size); }
  /// Writes the length of a sequence and returns it.
  std::uint64_t length(std::uint64_t count, std::size_t least_bytes);
  /// Writes what several places point to where it first comes, elsewhere its number.
  template <class T>
  void shared(std::shared_ptr<T>& x);
  /// The whole file: head, what was written, checksum.
  std::string file(const ArchiveFormat& format) const;

 private:
  // Number of what is pointed to, from 1, 0 for nothing; and whether it is new.
  std::pair<std::uint32_t, bool> number_of(std::shared_ptr<const void> x, std::type_index type);
  std::size_t enter(std::string_view name);
  void leave(std::size_t start);

  std::string bytes_;
  std::map<std::pair<const void*, std::type_index>, std::uint32_t> numbers_;
  std::vector<std::shared_ptr<const void>> kept_;  // so that no address is used twice
};

/// Reads what ArchiveWriter wrote. Everything that does not fit, lengths beyond the bytes that are left
/// included, is an InputError that names the source, what was found and what was expected.
class ArchiveReader {
 public:
  static constexpr bool kReading = true;

  /// The bytes of a whole file; `source` names it in messages. Throws InputError for another kind of file,
  /// one that is cut off or damaged, and another format.
  ArchiveReader(std::string file, const ArchiveFormat& format, std::string source);

  template <class... T>
  void operator()(T&&... values);
  template <class Content>
  void section(std::string_view name, const Content& content);

  void bytes(void* data, std::size_t size);
  /// Reads the length of a sequence whose elements take `least_bytes` each at least; the count is not used.
  std::uint64_t length(std::uint64_t count, std::size_t least_bytes);
  template <class T>
  void shared(std::shared_ptr<T>& x);
  std::size_t left() const { return end_ - at_; }
  /// Throws InputError: "source: text".
  [[noreturn]] void refuse(const std::string& text) const;
  /// Everything must have been read.
  void finish() const;

 private:
  std::uint32_t number_for(std::type_index type);  // 0 for nothing, one more than kept_ for what follows
  std::size_t enter(std::string_view name);        // returns the end of what the section lies in
  void leave(std::string_view name, std::size_t outer_end);

  std::string file_, source_;
  std::size_t at_ = 0, end_ = 0;
  std::vector<std::pair<std::shared_ptr<void>, std::type_index>> kept_;
};

template <class... T>
void ArchiveWriter::operator()(const T&... values) {
  (visit(*this, const_cast<T&>(values)), ...);  // visitors change nothing unless kReading
}

template <class Content>
void ArchiveWriter::section(std::string_view name, const Content& content) {
  const std::size_t start = enter(name);
  content();
  leave(start);
}

template <class T>
void ArchiveWriter::shared(std::shared_ptr<T>& x) {
  const auto [number, is_new] = number_of(x, typeid(T));
  (*this)(number);
  if (is_new) (*this)(*x);
}

template <class... T>
void ArchiveReader::operator()(T&&... values) {
  (visit(*this, values), ...);
}

template <class Content>
void ArchiveReader::section(std::string_view name, const Content& content) {
  const std::size_t outer_end = enter(name);
  content();
  leave(name, outer_end);
}

template <class T>
void ArchiveReader::shared(std::shared_ptr<T>& x) {
  using Made = std::remove_const_t<T>;
  const std::uint32_t number = number_for(typeid(T));
  x.reset();
  if (number == 0) return;
  if (number <= kept_.size()) {
    x = std::static_pointer_cast<T>(kept_[number - 1].first);
    return;
  }
  std::shared_ptr<Made> made(ArchiveAccess::make_new<Made>());
  kept_.emplace_back(made, typeid(T));
  (*this)(*made);
  x = std::move(made);
}

}  // namespace polyaffine

#include <polyaffine/core/archive_eigen.hpp>
#include <polyaffine/core/archive_types.hpp>
