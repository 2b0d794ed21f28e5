#include "check_command.hpp"

#include <iomanip>
#include <iostream>
#include <memory>

#include <cardiac/model/volume_check.hpp>
#include <cardiac/reduction/axes_check.hpp>
#include <polyaffine/core/error.hpp>

#include "example_data.hpp"
#include "load_mesh.hpp"
#include "warnings.hpp"

namespace cardiac::app {
namespace {

struct CheckOptions {
  std::string protocol;
  std::vector<std::string> overrides;
};

template <class Value>
void print_line(const char* what, const Value& value, const std::string& remark = "") {
  std::cout << std::left << std::setw(24) << what << value << (remark.empty() ? "" : "  (") << remark
            << (remark.empty() ? "" : ")") << '\n';
}

void check(const CheckOptions& options) {
  const Protocol protocol = load_input(given_or_example(options.protocol), options.overrides);
  const auto& anatomy = protocol.heart;
  print_warnings(protocol.warnings);
  const VolumeCheck found = check_volume(anatomy, protocol);
  std::cout << std::setprecision(3);
  std::vector<std::string> axes_warnings;
  const bool heart_axes = axes_of(*anatomy, protocol, axes_warnings) == protocol::Axes::heart;
  print_line("axes",
             protocol.reduction.weights == protocol::Weights::tents && heart_axes ? "heart" : "cartesian");
  print_line("radial axis, off by", radial_misfit_deg(*anatomy), "degrees from the way through the wall");
  if (const std::string text = untrained_warning(*anatomy, protocol); !text.empty())
    axes_warnings.push_back(text);
  print_warnings(axes_warnings);
  print_line("displacement unknowns", found.displacements);
  if (found.inf_sup) {
    const auto& [displacements, pressures, values, spurious] = *found.inf_sup;
    print_line("pressure unknowns", pressures);
    print_line("unknowns a pressure", static_cast<double>(displacements) / pressures);
    print_line("pressures not felt", spurious);
    std::cout << std::left << std::setw(24) << "smallest singular values";
    for (Eigen::Index k = 0; k < std::min<Eigen::Index>(5, values.size()); ++k) std::cout << ' ' << values[k];
    std::cout << "  (the first is the inf-sup constant)\n";
  } else {
    print_line("pressure unknowns", "none", "every integration point keeps its own volume");
  }
  print_line("compliance ratio", found.compliance_ratio, "Poisson's ratio 0.4999 over 0.3");
  print_warnings(found.warnings);
  if (!found.warnings.empty())
    throw polyaffine::ComputationError("check: the volume constraints do not fit the functions");
}

}  // namespace

void add_check_command(CLI::App& app) {
  auto* command = app.add_subcommand(
      "check", "Whether a protocol's reduced model locks, and whether it determines its pressures.");
  const auto options = std::make_shared<CheckOptions>();
  command->add_option("PROTOCOL", options->protocol, "protocol file (.toml)")->required();
  command->add_option("--set", options->overrides, "override a protocol key; the value in TOML")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->callback([options] { check(*options); });
}

}  // namespace cardiac::app
