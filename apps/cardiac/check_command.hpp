#pragma once

#include <CLI/CLI.hpp>

namespace cardiac::app {

/// `cardiac check`: whether a protocol's reduced model keeps volume without locking.
void add_check_command(CLI::App& app);

}  // namespace cardiac::app
