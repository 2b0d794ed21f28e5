#pragma once

#include <CLI/CLI.hpp>

namespace cardiac::app {

void add_validate_command(CLI::App& app);

}  // namespace cardiac::app
