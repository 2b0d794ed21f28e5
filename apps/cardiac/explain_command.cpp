#include "explain_command.hpp"

#include <iostream>
#include <memory>

#include <cardiac/protocol/describe.hpp>

namespace cardiac::app {

void add_explain_command(CLI::App& app) {
  auto* command =
      app.add_subcommand("explain", "Explain a protocol key: meaning, unit, default, range, source.");
  auto key = std::make_shared<std::string>();
  command->add_option("KEY", *key, "table.key, or a table for the list of its keys")->required();
  command->callback([key] { std::cout << explain(*key); });
}

}  // namespace cardiac::app
