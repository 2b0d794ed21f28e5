#pragma once

#include <filesystem>
#include <string>

namespace polyaffine {

/// The extension of a file in small letters (".stl" of "WALL.STL"), as some tools write it in capitals.
std::string lower_extension(const std::filesystem::path& file);

}  // namespace polyaffine
