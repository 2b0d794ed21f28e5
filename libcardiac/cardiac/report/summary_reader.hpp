#pragma once

#include <filesystem>
#include <string>

#include <cardiac/report/run_info.hpp>

namespace cardiac {

/// Reads a summary_text(): everything but instants and cavity samples; null numbers become NaN. `file` names
/// the source in messages. Throws InputError naming file and key of what is missing or of a wrong type.
StoredResult parse_summary(const std::string& text, const std::filesystem::path& file);

}  // namespace cardiac
