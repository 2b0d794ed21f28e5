#include "help_command.hpp"

#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "bash_completion.hpp"
#include "man_page.hpp"
#include "usage.hpp"

namespace cardiac::app {

void add_help_command(CLI::App& app) {
  struct Options {
    std::vector<std::string> path;
    bool man = false;
  };
  const auto o = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("help", "Print the help of the program or of a subcommand.");
  CLI::Option* path = command->add_option("SUBCOMMAND", o->path, "for instance run, or mesh import");
  command->add_flag("--man", o->man, "the manual page instead, as man reads it")->excludes(path);
  command->callback([o, &app] {
    if (o->man) {
      std::cout << man_page(app);
      return;
    }
    const CLI::App* found = &app;
    for (const std::string& name : o->path) found = &find_subcommand(*found, name);
    std::cout << help_of(*found);
  });
}

void add_completion_command(CLI::App& app) {
  const auto shell = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("completion", "Print what completes the command line in a shell.");
  command->add_option("SHELL", *shell, "for instance: source <(cardiac completion bash)")
      ->required()
      ->check(CLI::IsMember({"bash"}));
  command->callback([&app] { std::cout << bash_completion(app); });
}

}  // namespace cardiac::app
