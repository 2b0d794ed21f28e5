#pragma once

#include <CLI/CLI.hpp>

namespace cardiac::app {

/// `cardiac help [SUBCOMMAND…]`: what --help prints; `--man`: the manual page of all that was added to `app`.
void add_help_command(CLI::App& app);

/// `cardiac completion bash`: what a shell completes, of all that was added to `app`.
void add_completion_command(CLI::App& app);

}  // namespace cardiac::app
