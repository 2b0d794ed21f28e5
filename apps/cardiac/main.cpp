#include <CLI/CLI.hpp>
#include <iostream>

#include <polyaffine/core/error.hpp>

#include "bench_command.hpp"
#include "check_command.hpp"
#include "example_data.hpp"
#include "explain_command.hpp"
#include "help_command.hpp"
#include "mesh_command.hpp"
#include "reduce_command.hpp"
#include "report_command.hpp"
#include "run_command.hpp"
#include "schema_command.hpp"
#include "segment_command.hpp"
#include "strain_command.hpp"
#include "unload_command.hpp"
#include "usage.hpp"
#include "validate_command.hpp"

namespace {

enum ExitStatus { kDone = 0, kFailed = 1, kWrongInput = 2 };

int report(const std::exception& error, ExitStatus status) {
  std::cerr << "cardiac: error: " << error.what() << '\n';
  return status;
}

std::string examples() {
  const std::filesystem::path folder = cardiac::app::example_folder();
  return "Example: cardiac run protocols/healthy_lv.toml --out results/healthy_lv" +
         (folder.empty() ? "" : "\nProtocols and meshes of examples: " + folder.string());
}

int run_program(int argc, char** argv) {
  CLI::App app("Reduced cardiac mechanics: a heart beat on a ventricle mesh.", "cardiac");
  app.set_version_flag("-V,--version", "cardiac " CARDIAC_VERSION);
  app.footer(examples());
  app.require_subcommand(1);
  cardiac::app::add_run_command(app);
  cardiac::app::add_reduce_command(app);
  cardiac::app::add_mesh_command(app);
  cardiac::app::add_segment_command(app);
  cardiac::app::add_unload_command(app);
  cardiac::app::add_strain_command(app);
  cardiac::app::add_report_command(app);
  cardiac::app::add_schema_command(app);
  cardiac::app::add_explain_command(app);
  cardiac::app::add_validate_command(app);
  cardiac::app::add_bench_command(app);
  cardiac::app::add_check_command(app);
  cardiac::app::add_help_command(app);
  cardiac::app::add_completion_command(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return app.exit(error);
    std::cerr << "cardiac: error: " << cardiac::app::usage_error(app, error) << '\n';
    if (argc == 1)
      std::cerr << '\n' << cardiac::app::help_of(app);
    else
      std::cerr << "Run `cardiac help` or `cardiac help SUBCOMMAND` for the usage.\n";
    return kWrongInput;
  }
  return kDone;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const int status = run_program(argc, argv);
    if (!std::cout.flush()) throw polyaffine::ComputationError("cannot write to the standard output");
    return status;
  } catch (const polyaffine::InputError& error) {
    return report(error, kWrongInput);
  } catch (const std::exception& error) {
    return report(error, kFailed);
  }
}
