#include "run_command.hpp"

#include <algorithm>
#include <iomanip>
#include <iostream>
#include <memory>

#include <cardiac/protocol/plan.hpp>
#include <polyaffine/core/error.hpp>

namespace cardiac::app {
namespace {

struct RunOptions {
  std::string protocol;
  std::string out;
  std::string method;
  std::vector<std::string> overrides;
  bool verify = false, dry_run = false, resume = false, quiet = false, verbose = false;
};

void print_plan(const std::vector<PlanItem>& items) {
  std::size_t width = 0;
  for (const PlanItem& item : items) width = std::max(width, item.part.size());
  for (const PlanItem& item : items) {
    std::cout << std::left << std::setw(static_cast<int>(width) + 2) << item.part
              << (item.built ? "built     " : "left out  ") << item.why << '\n';
  }
}

void run(RunOptions options) {
  if (!options.method.empty()) options.overrides.push_back("reduction.method=" + options.method);
  const Protocol protocol = load_protocol(options.protocol, options.overrides);
  check_mesh_file(protocol);
  if (!options.quiet) {
    for (const std::string& warning : protocol.warnings) std::cerr << "cardiac: warning: " << warning << '\n';
  }
  const std::vector<PlanItem> items = plan(protocol, options.verify);
  if (options.dry_run) return print_plan(items);
  throw polyaffine::ComputationError("only --dry-run is available");
}

}  // namespace

void add_run_command(CLI::App& app) {
  auto* command = app.add_subcommand("run", "Compute the heart beat of a protocol on a ventricle mesh.");
  auto options = std::make_shared<RunOptions>();
  command->add_option("PROTOCOL", options->protocol, "protocol file (.toml)")->required();
  command->add_option("--out", options->out, "result directory (default: results/ and the protocol's name)")
      ->type_name("DIR");
  command->add_option("--set", options->overrides, "override a protocol key; the value in TOML")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_option("--method", options->method, "polyaffine (reduced) or fem (full order)")
      ->check(CLI::IsMember({"polyaffine", "fem"}));
  command->add_flag("--verify", options->verify, "also solve full order at end diastole and end systole");
  command->add_flag("--dry-run", options->dry_run, "check the input, print what would be built, and stop");
  command->add_flag("--resume", options->resume, "go on from the last state of an unfinished run");
  auto* quiet = command->add_flag("--quiet", options->quiet, "no progress, no warnings");
  command->add_flag("--verbose", options->verbose, "more detail")->excludes(quiet);
  command->callback([options] { run(*options); });
}

}  // namespace cardiac::app
