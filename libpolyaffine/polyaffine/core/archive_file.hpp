#pragma once

#include <filesystem>
#include <string>
#include <utility>

#include <polyaffine/core/archive.hpp>

namespace polyaffine {

/// The bytes of a file; throws InputError where it cannot be read.
std::string archive_bytes(const std::filesystem::path& file);
/// Puts a file in place, atomically. Throws as write_atomically.
void write_archive(const std::filesystem::path& file, const ArchiveFormat& format,
                   const ArchiveWriter& content);

/// Writes a value to a file, atomically. Throws as write_atomically.
template <class T>
void write_archive(const std::filesystem::path& file, const ArchiveFormat& format, const T& value) {
  ArchiveWriter out;
  out(value);
  write_archive(file, format, out);
}

/// A value of the bytes of a whole file; `source` names them in messages. Throws InputError as ArchiveReader.
template <class T>
T value_of_archive(std::string file, const ArchiveFormat& format, const std::string& source) {
  ArchiveReader in(std::move(file), format, source);
  T out = ArchiveAccess::make<T>();
  in(out);
  in.finish();
  return out;
}

/// Reads a value back. Throws InputError, naming the file, where it cannot be read or is not such a file.
template <class T>
T read_archive(const std::filesystem::path& file, const ArchiveFormat& format) {
  return value_of_archive<T>(archive_bytes(file), format, file.string());
}

}  // namespace polyaffine
