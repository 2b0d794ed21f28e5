#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

/// The bytes of a file.
inline std::string whole_file(const std::filesystem::path& file) {
  std::ostringstream out;
  out << std::ifstream(file, std::ios::binary).rdbuf();
  return out.str();
}
