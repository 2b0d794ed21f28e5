#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace cardiac::app {

/// A bash script that completes the subcommands and options of `app`, the values of options that take some
/// words only, protocol keys after --set and explain, and file names elsewhere.
std::string bash_completion(const CLI::App& app);

}  // namespace cardiac::app
