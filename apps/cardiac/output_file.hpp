#pragma once

#include <filesystem>
#include <string>

namespace cardiac::app {

/// Throws InputError when the file of an --out option has another extension, lies in no folder, or is a
/// folder itself; asked before anything is computed.
void check_output_file(const std::filesystem::path& file, const std::string& extension);

}  // namespace cardiac::app
