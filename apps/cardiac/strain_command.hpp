#pragma once

#include <CLI/CLI.hpp>

namespace cardiac::app {

/// Registers `cardiac strain RESULT_DIR [--frames | --peaks] [--out FILE.csv]`: the segment tables of a
/// finished run, to stdout where no file is named. Errors of the callback pass through CLI::App::parse.
void add_strain_command(CLI::App& app);

}  // namespace cardiac::app
