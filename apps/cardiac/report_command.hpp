#pragma once

#include <CLI/CLI.hpp>

namespace cardiac::app {

/// Registers `cardiac report RESULT_DIR`: (re)writes figures and report.html of a finished run from its
/// tables. Errors of the callback pass through CLI::App::parse.
void add_report_command(CLI::App& app);

}  // namespace cardiac::app
