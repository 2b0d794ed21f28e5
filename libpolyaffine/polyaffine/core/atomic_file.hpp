#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

namespace polyaffine {

/// Makes `folder` and its parents where missing. Throws InputError naming the path and the system's reason,
/// also where the folder cannot be written into.
void make_folder(const std::filesystem::path& folder);

/// Removes from a folder the temporary files of write_atomically whose process was killed.
void remove_abandoned(const std::filesystem::path& folder);

/// Calls `write` with a temporary name in the folder of `target` (same extension), then renames the file to
/// `target`: a reader sees the old file or the whole new one. When anything fails the temporary file is
/// removed and the old one stays. Exceptions of `write` pass through; throws InputError where the file cannot
/// be put at `target`, ComputationError where `write` left no file.
void write_atomically(const std::filesystem::path& target,
                      const std::function<void(const std::filesystem::path&)>& write);

/// The same for a text at hand. Throws InputError where the file cannot be made (missing or read-only
/// folder), ComputationError where it cannot be written to its end (full disk); both name path and reason.
void write_atomically(const std::filesystem::path& target, std::string_view text);

}  // namespace polyaffine
