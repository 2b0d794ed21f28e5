#pragma once

#include <CLI/CLI.hpp>

namespace cardiac::app {

void add_bench_command(CLI::App& app);

}  // namespace cardiac::app
