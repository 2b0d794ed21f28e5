#include "usage.hpp"

#include <algorithm>
#include <functional>
#include <sstream>

#include <cardiac/protocol/nearest_key.hpp>
#include <polyaffine/core/error.hpp>

namespace cardiac::app {
namespace {

std::string list_of(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::vector<std::string> names_of(const std::vector<const CLI::App*>& commands) {
  std::vector<std::string> names;
  for (const CLI::App* command : commands) names.push_back(command->get_name());
  return names;
}

// All spellings of the options: "--quiet", "-h".
std::vector<std::string> spellings(const CLI::App& command) {
  std::vector<std::string> out;
  for (const CLI::Option* option : options_of(command)) {
    for (const std::string& name : option->get_lnames()) out.push_back("--" + name);
    for (const std::string& name : option->get_snames()) out.push_back("-" + name);
  }
  return out;
}

// A word is near where it is the beginning of a known one, or a third of it at most is to be changed.
std::string suggestion(const std::string& word, const std::vector<std::string>& known, const char* all) {
  if (known.empty()) return "";
  const auto distance = [&](const std::string& other) {
    return other.starts_with(word) ? 0 : protocol::edit_distance(word, other);
  };
  const std::string nearest = std::ranges::min(known, {}, distance);
  if (3 * distance(nearest) <= static_cast<int>(std::max<std::size_t>(word.size(), 4)))
    return "; the nearest is " + nearest;
  return std::string("; ") + all + list_of(known);
}

std::string unknown_subcommand(const CLI::App& command, const std::string& name) {
  return "unknown subcommand " + name + " of " + full_name(command) +
         suggestion(name, names_of(subcommands_of(command)), "there are ");
}

// The subcommand that the command line names, as far as it names one.
const CLI::App& deepest(const CLI::App& app) {
  const CLI::App* at = &app;
  while (!at->get_subcommands().empty()) at = at->get_subcommands().back();
  return *at;
}

// To the parser a group of options is a subcommand without a name.
std::vector<const CLI::Option*> of_command_and_groups(const CLI::App& command,
                                                      const std::function<bool(const CLI::Option*)>& which) {
  std::vector<const CLI::Option*> out = command.get_options(which);
  for (const CLI::App* group :
       command.get_subcommands([](const CLI::App* one) { return one->get_name().empty(); }))
    for (const CLI::Option* option : of_command_and_groups(*group, which)) out.push_back(option);
  return out;
}

}  // namespace

std::string full_name(const CLI::App& command) {
  const CLI::App* parent = command.get_parent();
  return parent == nullptr ? command.get_name() : full_name(*parent) + ' ' + command.get_name();
}

std::string help_of(const CLI::App& command) {
  // Not App::help(), which gives that of the subcommand that was parsed.
  return command.get_formatter()->make_help(&command, full_name(command), CLI::AppFormatMode::Normal);
}

std::vector<const CLI::App*> subcommands_of(const CLI::App& command) {
  return command.get_subcommands([](const CLI::App* one) { return !one->get_name().empty(); });
}

std::vector<const CLI::Option*> options_of(const CLI::App& command) {
  return of_command_and_groups(command, [](const CLI::Option* option) { return option->nonpositional(); });
}

std::vector<const CLI::Option*> positionals_of(const CLI::App& command) {
  return of_command_and_groups(command, [](const CLI::Option* option) { return option->get_positional(); });
}

std::vector<std::string> choices_of(const CLI::Option& option) {
  // The parser keeps them only in the name of the type: TEXT:{polyaffine,fem}.
  const std::string type = option.get_type_name();
  const auto open = type.find('{'), close = type.find('}');
  std::vector<std::string> words;
  if (open == std::string::npos || close == std::string::npos) return words;
  std::istringstream list(type.substr(open + 1, close - open - 1));
  for (std::string word; std::getline(list, word, ',');) words.push_back(word);
  return words;
}

const CLI::App& find_subcommand(const CLI::App& command, const std::string& name) {
  for (const CLI::App* one : subcommands_of(command))
    if (one->get_name() == name) return *one;
  if (subcommands_of(command).empty())
    throw polyaffine::InputError("unexpected argument " + name + ": " + full_name(command) +
                                 " has no subcommands");
  throw polyaffine::InputError(unknown_subcommand(command, name));
}

std::string usage_error(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App& command = deepest(app);
  const auto missed = command.remaining();
  const bool has_subcommands = !subcommands_of(command).empty();
  if (!missed.empty()) {
    const std::string word = missed.front().substr(0, missed.front().find('='));
    if (word.size() > 1 && word.front() == '-')
      return "unknown option " + word + " of " + full_name(command) +
             suggestion(word, spellings(command), "its options are ");
    if (has_subcommands) return unknown_subcommand(command, word);
    return "unexpected argument " + missed.front() + " of " + full_name(command);
  }
  if (has_subcommands && command.get_subcommands().empty())
    return "a subcommand of " + full_name(command) + " is missing, expected one of " +
           list_of(names_of(subcommands_of(command)));
  return error.what();
}

}  // namespace cardiac::app
