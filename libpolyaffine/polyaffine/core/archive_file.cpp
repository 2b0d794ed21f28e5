#include "polyaffine/core/archive_file.hpp"

#include <fstream>
#include <system_error>

#include <polyaffine/core/atomic_file.hpp>
#include <polyaffine/core/error.hpp>

namespace polyaffine {

std::string archive_bytes(const std::filesystem::path& file) {
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  std::string out(error ? 0 : size, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(out.data(), static_cast<std::streamsize>(out.size()));
  if (error || !in) throw InputError(file.string() + ": cannot read it, expected a file");
  return out;
}

void write_archive(const std::filesystem::path& file, const ArchiveFormat& format,
                   const ArchiveWriter& content) {
  write_atomically(file, content.file(format));
}

}  // namespace polyaffine
