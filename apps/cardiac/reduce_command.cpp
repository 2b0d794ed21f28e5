#include "reduce_command.hpp"

#include <algorithm>
#include <iomanip>
#include <iostream>
#include <memory>
#include <sstream>

#include <cardiac/report/filling.hpp>
#include <cardiac/run/tuned_model.hpp>
#include <cardiac/run/unload.hpp>
#include <polyaffine/core/error.hpp>

#include "example_data.hpp"
#include "heart_model.hpp"
#include "interrupt.hpp"
#include "load_mesh.hpp"
#include "progress.hpp"
#include "warnings.hpp"

namespace cardiac::app {
namespace {

struct ReduceOptions {
  std::string protocol, out;
  std::vector<std::string> overrides;
  double accuracy_percent = 0, budget_s = 0;  // 0: of the protocol
  bool quiet = false;
};

void print_head() {
  std::cout << "full-order                             held out, displacement %\n"
               "    solves  unknowns  points  seconds  protocol  other segments  volume %  worst load\n";
}

void print_round(const TuningRound& r) {
  const bool by_segments =
      r.segments.displacement_percent > kSegmentsAllowance * r.protocol.displacement_percent;
  std::cout << std::fixed << std::setw(10) << r.full_order_solves << std::setw(10) << r.unknowns
            << std::setw(8) << r.points << std::setw(9) << std::setprecision(1) << r.seconds
            << std::setprecision(2) << std::setw(10) << r.protocol.displacement_percent << std::setw(16)
            << r.segments.displacement_percent << std::setw(10)
            << std::max(r.protocol.volume_percent, r.segments.volume_percent) << "  "
            << (by_segments ? r.segments : r.protocol).load << std::endl;
}

// A model file holds the stress-free shape alone, where nothing tells the place of a site in the image.
void check_unloading(const Protocol& protocol) {
  if (!protocol.imaged || !protocol.activation) return;
  if (protocol.activation->sites_mm.empty() && protocol.activation->mode != scene::ActivationMode::table)
    return;
  throw polyaffine::InputError(
      "activation: found places in mm (sites_mm or times_file) beside mesh.pressure_mmHg, which a model file "
      "does not keep; expected activation.site_segments or mode = \"uniform\", or the mesh of `cardiac "
      "unload` without mesh.pressure_mmHg");
}

std::string number(double value) {
  std::ostringstream out;
  out << std::setprecision(17) << value;
  return out.str();
}

void reduce(const ReduceOptions& options) {
  std::vector<std::string> overrides = options.overrides;
  overrides.emplace_back("reduction.preset=tuned");
  if (options.accuracy_percent > 0)
    overrides.push_back("reduction.accuracy_percent=" + number(options.accuracy_percent));
  if (options.budget_s > 0) overrides.push_back("reduction.budget_s=" + number(options.budget_s));
  const std::filesystem::path source = given_or_example(options.protocol);
  Protocol protocol = load_input(source, overrides);
  if (protocol.reduction.method != scene::Method::polyaffine)
    throw polyaffine::InputError("reduction.method: found fem, expected polyaffine for a reduced model");
  check_unloading(protocol);
  print_warnings(protocol.warnings);
  const InterruptGuard interrupt;
  {
    ProgressLine line(options.quiet);
    RunControl control;
    control.progress = [&line](const std::string& what, double fraction) { line(what, fraction); };
    control.stop_reason = [&interrupt] { return interrupt.reason(); };
    if (protocol.imaged) {
      const Unloading found = unload(protocol, control);
      static_cast<Scene&>(protocol) = unloaded_scene(protocol, found.heart);
      print_warnings(found.warnings);
      if (!options.quiet) std::cout << unloading_text(found.result) << std::endl;
    }
    if (!options.quiet) print_head();
    control.on_round = [&options](const TuningRound& round) {
      if (!options.quiet) print_round(round);
    };
    protocol.tuned = tuned_model(protocol.heart, protocol, control);
  }
  save_model(options.out, protocol, source, overrides);
  const TuningRound& last = protocol.tuned->rounds.back();
  if (!options.quiet)
    std::cout << std::fixed << std::setprecision(2) << options.out << ": " << last.unknowns << " unknowns, "
              << last.points << " points, " << last.protocol.displacement_percent
              << " % of displacement off at most in loads held out, " << last.segments.displacement_percent
              << " % with other segments; learned from " << last.full_order_solves << " full-order solves in "
              << std::setprecision(0) << last.seconds << " s\n";
  if (!protocol.tuned->reached)
    print_warnings({"the accuracy of " + number(protocol.reduction.accuracy_percent) + " % (" +
                    number(kSegmentsAllowance * protocol.reduction.accuracy_percent) +
                    " % with other segments) was not reached within the budget (--budget)"});
}

}  // namespace

void add_reduce_command(CLI::App& app) {
  auto* command = app.add_subcommand(
      "reduce", "Learn the reduced model of one heart from its full-order model and write it to a file.");
  auto options = std::make_shared<ReduceOptions>();
  command->add_option("PROTOCOL", options->protocol, "protocol file (.toml)")->required();
  command->add_option("--out", options->out, "model file to write")->type_name("HEART.model")->required();
  command
      ->add_option("--accuracy", options->accuracy_percent,
                   "largest error of displacement in loads held out, % (reduction.accuracy_percent)")
      ->type_name("PERCENT")
      ->check(CLI::Range(0.05, 20.0));
  command->add_option("--budget", options->budget_s, "time it may take (reduction.budget_s)")
      ->type_name("SECONDS")
      ->check(CLI::PositiveNumber);
  command->add_option("--set", options->overrides, "override a protocol key; the value in TOML")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_flag("--quiet", options->quiet, "no progress, no table; warnings go to stderr in any case");
  command->callback([options] { reduce(*options); });
}

}  // namespace cardiac::app
