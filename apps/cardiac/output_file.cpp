#include "output_file.hpp"

#include <polyaffine/core/error.hpp>

namespace cardiac::app {

using polyaffine::InputError;

void check_output_file(const std::filesystem::path& file, const std::string& extension,
                       const std::string& option, const std::filesystem::path& read) {
  if (file.extension() != extension)
    throw InputError(option + ": found \"" + file.string() + "\", expected a file name that ends in " +
                     extension);
  const auto folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  if (!std::filesystem::is_directory(folder))
    throw InputError(option + ": found no folder " + folder.string() + " to write into");
  if (std::filesystem::is_directory(file))
    throw InputError(option + ": found the folder " + file.string() + ", expected a file name");
  std::error_code none;
  if (!read.empty() && std::filesystem::equivalent(file, read, none))
    throw InputError(option + ": found \"" + file.string() + "\", the file that is read, expected another");
}

}  // namespace cardiac::app
