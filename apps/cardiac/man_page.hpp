#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace cardiac::app {

/// The manual page cardiac(1) in the macros of man(7): every subcommand of `app` with its arguments and
/// options, exit status and files.
std::string man_page(const CLI::App& app);

}  // namespace cardiac::app
