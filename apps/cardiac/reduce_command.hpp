#pragma once

#include <CLI/CLI.hpp>

namespace cardiac::app {

/// cardiac reduce PROTOCOL: learns the reduced model of one heart and writes it to a file.
void add_reduce_command(CLI::App& app);

}  // namespace cardiac::app
