#include "explain_command.hpp"

#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <cardiac/protocol/describe.hpp>

namespace cardiac::app {

void add_explain_command(CLI::App& app) {
  auto* command = app.add_subcommand(
      "explain",
      "Explain the keys of a protocol: meaning, unit, default, range, source; or find one by words.");
  auto words = std::make_shared<std::vector<std::string>>();
  command->add_option(
      "KEY", *words,
      "table.key; a table for its keys; words that the meaning of a key holds; nothing for the "
      "tables");
  command->callback([words] {
    std::string all;
    for (const std::string& word : *words) all += (all.empty() ? "" : " ") + word;
    std::cout << explain(all);
  });
}

}  // namespace cardiac::app
