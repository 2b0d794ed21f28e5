#pragma once

#include <filesystem>
#include <string>

namespace cardiac::app {

/// Throws InputError when the file of an option has another extension, lies in no folder, is a folder itself
/// or the file that is read; asked before anything is computed.
void check_output_file(const std::filesystem::path& file, const std::string& extension,
                       const std::string& option = "--out", const std::filesystem::path& read = {});

}  // namespace cardiac::app
