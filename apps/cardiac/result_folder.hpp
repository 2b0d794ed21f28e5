#pragma once

#include <filesystem>

namespace cardiac::app {

/// Removes what an earlier run left in a result folder: it would be taken for that of the run which begins,
/// when that one is killed or writes less. The summary goes first: a folder without one is not whole. The
/// checkpoint and other people's files stay.
void remove_old_results(const std::filesystem::path& folder);

/// Throws InputError when a file that a run reads would be removed by it.
void check_not_a_result(const std::filesystem::path& read, const std::filesystem::path& folder);

}  // namespace cardiac::app
