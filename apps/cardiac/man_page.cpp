#include "man_page.hpp"

#include <algorithm>
#include <cctype>
#include <sstream>

#include "usage.hpp"

namespace cardiac::app {
namespace {

// Text as roff takes it literally; a line must not begin with a control character.
std::string literal(const std::string& text) {
  std::string out;
  for (const char letter : text) {
    if (letter == '\\')
      out += "\\e";
    else if (letter == '-')
      out += "\\-";
    else if (letter == '\n')
      out += ' ';
    else
      out += letter;
  }
  return (out.starts_with('.') || out.starts_with('\'') ? "\\&" : "") + out;
}

std::string upper(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

// "TEXT:{a,b}" as "a | b", a type of numbers or texts as it is.
std::string type_of(const CLI::Option& option) {
  if (option.get_items_expected_max() == 0) return "";
  std::string text;
  for (const std::string& word : choices_of(option)) text += (text.empty() ? "" : " | ") + word;
  return text.empty() ? option.get_type_name() : text;
}

void add_option(const CLI::Option& option, const std::string& names, std::ostringstream& out) {
  const std::string type = option.get_positional() ? "" : type_of(option);
  out << ".TP\n\\fB" << literal(names) << "\\fR" << (type.empty() ? "" : " \\fI" + literal(type) + "\\fR")
      << '\n'
      << literal(option.get_description());
  if (const std::string standard = option.get_default_str(); !standard.empty())
    out << " (default: " << literal(standard) << ')';
  out << '\n';
}

void add_command(const CLI::App& command, std::ostringstream& out) {
  out << ".SS \"" << literal(full_name(command)) << "\"\n" << literal(command.get_description()) << '\n';
  for (const CLI::Option* option : positionals_of(command)) add_option(*option, option->get_name(true), out);
  for (const CLI::Option* option : options_of(command))
    if (option->get_name() != "--help") add_option(*option, option->get_name(false, true), out);
  for (const CLI::App* one : subcommands_of(command)) add_command(*one, out);
}

}  // namespace

std::string man_page(const CLI::App& app) {
  const std::string name = app.get_name();
  std::ostringstream out;
  out << ".TH " << upper(name) << " 1 \"\" \"" << name << ' ' << CARDIAC_VERSION << "\" \"User Commands\"\n"
      << ".SH NAME\n"
      << name << " \\- " << literal(app.get_description()) << "\n.SH SYNOPSIS\n.B " << name
      << "\n.I SUBCOMMAND\n[\\fIARGUMENT\\fR]... [\\fIOPTION\\fR]...\n.SH OPTIONS\n";
  for (const CLI::Option* option : options_of(app)) add_option(*option, option->get_name(false, true), out);
  out << ".PP\nEvery subcommand takes \\fB\\-h\\fR, \\fB\\-\\-help\\fR too.\n.SH SUBCOMMANDS\n";
  for (const CLI::App* one : subcommands_of(app)) add_command(*one, out);
  out << ".SH EXIT STATUS\n"
         ".TP\n0\ndone\n"
         ".TP\n1\na computation or a check failed\n"
         ".TP\n2\nthe input or the command line is wrong; earlier results are as they were\n"
         ".SH FILES\n"
         ".TP\n\\fI../share/"
      << name
      << "/\\fR (of the folder of the program)\n"
         "example protocols and meshes: a protocol or mesh that is not where its path says is looked for "
         "there\n"
         ".TP\n\\fI../share/doc/"
      << name
      << "/\\fR\nthe documentation: files of a run, accuracy, limits\n"
         ".SH BUGS\nA model, not a measurement: not for diagnosis.\n";
  return out.str();
}

}  // namespace cardiac::app
