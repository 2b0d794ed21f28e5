#pragma once

#include <CLI/CLI.hpp>

namespace cardiac::app {

/// cardiac unload PROTOCOL --out FILE.vtu
void add_unload_command(CLI::App& app);

}  // namespace cardiac::app
