#pragma once

#include <filesystem>
#include <string>

#include <cardiac/report/run_info.hpp>

namespace cardiac {

/// The report of a run as one HTML page that needs nothing beside itself: headline numbers, figures, table of
/// the segments, plan, verification, mesh, method and run time; warnings and the reason of a run that stopped
/// come first. `wall_svg` is a drawing of the deformed wall to stand before the other figures, as it is, if
/// there is one. Every other text is escaped, values that do not exist are dashes.
std::string report_page(const BeatResult& result, const RunInfo& info, const std::string& title,
                        const std::string& wall_svg = {});

/// Writes report.html into the folder `out` (made where missing), whole or not at all; its title is the
/// folder's name. Errors as of polyaffine::write_atomically.
void write_report_page(const BeatResult& result, const RunInfo& info, const std::filesystem::path& out,
                       const std::string& wall_svg = {});

}  // namespace cardiac
