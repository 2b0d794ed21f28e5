#include "polyaffine/mesh_io/file_extension.hpp"

#include <algorithm>
#include <cctype>

namespace polyaffine {

std::string lower_extension(const std::filesystem::path& file) {
  std::string out = file.extension().string();
  std::ranges::transform(out, out.begin(), [](unsigned char c) { return std::tolower(c); });
  return out;
}

}  // namespace polyaffine
