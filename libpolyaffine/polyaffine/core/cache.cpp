#include "polyaffine/core/cache.hpp"

#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <span>
#include <sstream>

#include <polyaffine/core/atomic_file.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/core/fnv1a.hpp>

namespace polyaffine {
namespace {

std::filesystem::path cache_file(const std::string& kind, const std::string& key) {
  const auto folder = cache_folder();
  if (folder.empty()) return {};
  Fnv1a sum;
  sum.add(std::span(key.data(), key.size()));
  std::ostringstream name;
  name << kind << '-' << std::hex << std::setfill('0') << std::setw(16) << sum.value();
  return folder / name.str();
}

// What precedes the data.
std::string head(const std::string& key) {
  return std::to_string(key.size()) + '\n' + key + '\n';
}

}  // namespace

std::filesystem::path cache_folder() {
  const auto variable = [](const char* name) {
    const char* value = std::getenv(name);
    return std::filesystem::path(value ? value : "");
  };
  if (const auto cache = variable("XDG_CACHE_HOME"); cache.is_absolute()) return cache / "cardiac";
  if (const auto home = variable("HOME"); home.is_absolute()) return home / ".cache" / "cardiac";
  return {};
}

std::optional<std::string> read_cache(const std::string& kind, const std::string& key) {
  const auto file = cache_file(kind, key);
  std::ifstream in(file, std::ios::binary);
  if (file.empty() || !in) return {};
  std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::string expected = head(key);
  if (!text.starts_with(expected)) return {};
  return text.substr(expected.size());
}

void write_cache(const std::string& kind, const std::string& key, const std::string& data) {
  const auto file = cache_file(kind, key);
  if (file.empty()) return;
  try {
    make_folder(file.parent_path());
    write_atomically(file, head(key) + data);
  } catch (const std::exception&) {
    return;  // a cache that cannot be written only costs time
  }
}

}  // namespace polyaffine
