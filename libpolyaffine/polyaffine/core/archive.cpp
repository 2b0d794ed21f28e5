#include "polyaffine/core/archive.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <span>

#include <polyaffine/core/error.hpp>
#include <polyaffine/core/fnv1a.hpp>

namespace polyaffine {
namespace {

static_assert(std::endian::native == std::endian::little, "archives are written as numbers lie in memory");
static_assert(std::numeric_limits<double>::is_iec559 && sizeof(int) == 4);

// As in PNG files: a byte above 127 and both line ends, which transfers as text would change.
constexpr std::string_view kMagic = "\x89PAF\r\n\x1a\n";
// Of matrices and sequences, also of those that take no bytes.
constexpr std::uint64_t kMostLength = std::numeric_limits<std::int32_t>::max();

std::uint64_t checksum(std::string_view text) {
  Fnv1a sum;
  sum.add(std::span(text.data(), text.size()));
  return sum.value();
}

std::string in_words(const ArchiveFormat& format) {
  return '"' + format.name + "\" of version " + std::to_string(format.version);
}

// For a message: the beginning of a name that a file gives.
std::string shown(const std::string& name) {
  std::string out = name.substr(0, 40);
  std::ranges::replace_if(
      out, [](unsigned char c) { return c < 32 || c > 126; }, '?');
  return '"' + out + '"';
}

}  // namespace

std::uint64_t ArchiveWriter::length(std::uint64_t count, std::size_t) {
  (*this)(count);
  return count;
}

std::pair<std::uint32_t, bool> ArchiveWriter::number_of(std::shared_ptr<const void> x, std::type_index type) {
  if (!x) return {0, false};
  const auto next = static_cast<std::uint32_t>(numbers_.size()) + 1;
  const auto [at, is_new] = numbers_.try_emplace({x.get(), type}, next);
  if (is_new) kept_.push_back(std::move(x));
  return {at->second, is_new};
}

std::size_t ArchiveWriter::enter(std::string_view name) {
  (*this)(std::string(name), std::uint64_t{0});
  return bytes_.size();
}

void ArchiveWriter::leave(std::size_t start) {
  const std::uint64_t size = bytes_.size() - start;
  std::memcpy(bytes_.data() + start - sizeof size, &size, sizeof size);
}

std::string ArchiveWriter::file(const ArchiveFormat& format) const {
  ArchiveWriter head;
  head(format.name, format.version);
  const std::uint64_t size = kMagic.size() + head.bytes_.size() + bytes_.size() + 2 * sizeof size;
  ArchiveWriter out;
  out.bytes_.reserve(size);
  out.bytes(kMagic.data(), kMagic.size());
  out(size);
  out.bytes_ += head.bytes_;
  out.bytes_ += bytes_;
  out(checksum(out.bytes_));
  return std::move(out.bytes_);
}

ArchiveReader::ArchiveReader(std::string file, const ArchiveFormat& format, std::string source)
    : file_(std::move(file)), source_(std::move(source)), end_(file_.size()) {
  std::uint64_t size = 0, sum = 0;
  if (!std::string_view(file_).starts_with(kMagic) || left() < kMagic.size() + 2 * sizeof size)
    refuse("found another kind of file, expected " + in_words(format));
  at_ = kMagic.size();
  (*this)(size);
  if (size != file_.size())
    refuse("found " + std::to_string(file_.size()) + " bytes, expected " + std::to_string(size) +
           "; the file is cut off or damaged");
  end_ -= sizeof sum;
  std::memcpy(&sum, file_.data() + end_, sizeof sum);
  if (checksum(std::string_view(file_).substr(0, end_)) != sum)
    refuse("found a checksum that does not fit, expected that of the bytes; the file is damaged");
  ArchiveFormat found;
  (*this)(found.name);
  if (found.name != format.name) refuse("found " + shown(found.name) + ", expected " + in_words(format));
  (*this)(found.version);
  if (found.version != format.version)
    refuse("found version " + std::to_string(found.version) + ", expected " + in_words(format) +
           "; it was written by another version of the program");
}

void ArchiveReader::bytes(void* data, std::size_t size) {
  if (size > left())
    refuse("found " + std::to_string(left()) + " bytes where " + std::to_string(size) + " were expected");
  if (size == 0) return;
  std::memcpy(data, file_.data() + at_, size);
  at_ += size;
}

std::uint64_t ArchiveReader::length(std::uint64_t, std::size_t least_bytes) {
  std::uint64_t count = 0;
  (*this)(count);
  const std::uint64_t most = least_bytes > 0 ? left() / least_bytes : kMostLength;
  if (count > most)
    refuse("found the length " + std::to_string(count) + ", expected at most " + std::to_string(most));
  return count;
}

std::uint32_t ArchiveReader::number_for(std::type_index type) {
  std::uint32_t number = 0;
  (*this)(number);
  const bool known = number >= 1 && number <= kept_.size();
  if (number > kept_.size() + 1 || (known && kept_[number - 1].second != type))
    refuse("found a reference to value " + std::to_string(number) + ", expected one of its type");
  return number;
}

std::size_t ArchiveReader::enter(std::string_view name) {
  std::string found;
  (*this)(found);
  if (found != name) refuse("found the section " + shown(found) + ", expected \"" + std::string(name) + '"');
  const std::size_t outer_end = end_;
  end_ = length(0, 1);
  end_ += at_;
  return outer_end;
}

void ArchiveReader::leave(std::string_view name, std::size_t outer_end) {
  if (left() > 0)
    refuse("section \"" + std::string(name) + "\": found " + std::to_string(left()) +
           " bytes too many, expected none");
  end_ = outer_end;
}

void ArchiveReader::refuse(const std::string& text) const {
  throw InputError(source_ + ": " + text);
}

void ArchiveReader::finish() const {
  if (left() > 0) refuse("found " + std::to_string(left()) + " bytes too many, expected none");
}

}  // namespace polyaffine
