#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace cardiac::app {

/// The name with those of the commands above it: "cardiac mesh import".
std::string full_name(const CLI::App& command);

/// Its help, as --help prints it.
std::string help_of(const CLI::App& command);

/// Its subcommands, in the order in which they were added.
std::vector<const CLI::App*> subcommands_of(const CLI::App& command);

/// Its options but the positional ones, in the order in which they were added, those of its groups behind.
std::vector<const CLI::Option*> options_of(const CLI::App& command);
std::vector<const CLI::Option*> positionals_of(const CLI::App& command);

/// The words that an option may take, where it takes some words only.
std::vector<std::string> choices_of(const CLI::Option& option);

/// The subcommand of that name. Throws polyaffine::InputError naming the nearest one, or all.
const CLI::App& find_subcommand(const CLI::App& command, const std::string& name);

/// What is wrong with a command line that `app` did not take: an unknown subcommand or option by name, with
/// the nearest one; a subcommand that is missing, with those there are; else what the parser says.
std::string usage_error(const CLI::App& app, const CLI::ParseError& error);

}  // namespace cardiac::app
