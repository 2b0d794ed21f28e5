#include "schema_command.hpp"

#include <iostream>
#include <nlohmann/json.hpp>

#include <cardiac/protocol/describe.hpp>

namespace cardiac::app {

void add_schema_command(CLI::App& app) {
  app.add_subcommand("schema", "Print the JSON schema of a protocol.")->callback([] {
    std::cout << protocol_schema().dump(2) << '\n';
  });
}

}  // namespace cardiac::app
