#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace polyaffine {

/// Where derived data that is dear to compute is kept between runs: $XDG_CACHE_HOME/cardiac, or
/// ~/.cache/cardiac; empty when neither variable is set. Safe to delete at any time.
std::filesystem::path cache_folder();

/// The data stored under a key, if there is any. `kind` (a word) names the file together with a checksum of
/// the key; the whole key is kept in it and compared.
std::optional<std::string> read_cache(const std::string& kind, const std::string& key);

/// Stores data under a key, atomically. Does nothing where the folder cannot be written.
void write_cache(const std::string& kind, const std::string& key, const std::string& data);

}  // namespace polyaffine
