#include "bash_completion.hpp"

#include <sstream>
#include <vector>

#include <cardiac/protocol/describe.hpp>

#include "usage.hpp"

namespace cardiac::app {
namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

std::vector<std::string> spellings(const CLI::Option& option) {
  std::vector<std::string> out;
  for (const std::string& name : option.get_lnames()) out.push_back("--" + name);
  for (const std::string& name : option.get_snames()) out.push_back("-" + name);
  return out;
}

bool takes_value(const CLI::Option& option) {
  return option.get_items_expected_max() > 0;
}

std::string alternatives(const CLI::Option& option) {
  std::string text;
  for (const std::string& word : spellings(option)) text += (text.empty() ? "" : "|") + word;
  return text;
}

// What may stand where a value of the option is expected; keys stand in a variable of the script.
std::string values_of(const CLI::Option& option) {
  if (option.get_type_name() == "KEY=VALUE") return "$keys";
  return joined(choices_of(option));
}

void add_command(const CLI::App& command, std::ostringstream& out) {
  std::vector<std::string> words, plain;
  for (const CLI::App* one : subcommands_of(command)) plain.push_back(one->get_name());
  for (const CLI::Option* one : positionals_of(command))
    for (const std::string& choice : choices_of(*one)) plain.push_back(choice);
  if (command.get_name() == "explain") plain.emplace_back("$keys");
  if (command.get_name() == "help")
    for (const CLI::App* one : subcommands_of(*command.get_parent())) plain.push_back(one->get_name());
  out << "    \"" << full_name(command) << "\")\n      options=\"";
  for (const CLI::Option* one : options_of(command))
    for (const std::string& word : spellings(*one)) words.push_back(word);
  out << joined(words) << "\"\n      words=\"" << joined(plain) << "\"\n      case $previous in\n";
  for (const CLI::Option* one : options_of(command))
    if (takes_value(*one))
      out << "        " << alternatives(*one) << ") value=yes; words=\"" << values_of(*one) << "\" ;;\n";
  out << "      esac\n      ;;\n";
  for (const CLI::App* one : subcommands_of(command)) add_command(*one, out);
}

void add_names(const CLI::App& command, std::ostringstream& out) {
  for (const CLI::App* one : subcommands_of(command)) {
    out << (out.str().empty() ? "" : "|") << '"' << full_name(*one) << '"';
    add_names(*one, out);
  }
}

}  // namespace

std::string bash_completion(const CLI::App& app) {
  std::ostringstream names, commands;
  add_names(app, names);
  add_command(app, commands);
  return "# Completion of " + app.get_name() + " in bash, written by `" + app.get_name() +
         " completion bash`.\n"
         "_" +
         app.get_name() +
         "() {\n"
         "  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}\n"
         "  local command=" +
         app.get_name() +
         " options= words= value=no i\n"
         "  local keys=\"" +
         joined(key_paths()) +
         "\"\n"
         "  for ((i = 1; i < COMP_CWORD; i++)); do\n"
         "    case \"$command ${COMP_WORDS[i]}\" in\n"
         "      " +
         names.str() +
         ") command+=\" ${COMP_WORDS[i]}\" ;;\n"
         "    esac\n"
         "  done\n"
         "  case $command in\n" +
         commands.str() +
         "  esac\n"
         "  [[ $value == no && $current == -* ]] && words=$options\n"
         "  COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
         "}\n"
         "complete -o default -F _" +
         app.get_name() + ' ' + app.get_name() + '\n';
}

}  // namespace cardiac::app
