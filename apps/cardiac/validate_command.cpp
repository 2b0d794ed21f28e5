#include "validate_command.hpp"

#include <filesystem>
#include <iomanip>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <cardiac/validation/check.hpp>
#include <polyaffine/core/atomic_file.hpp>
#include <polyaffine/core/error.hpp>

#include "bench_hearts.hpp"
#include "biventricle_mesh.hpp"
#include "box_mesh.hpp"
#include "ellipsoid_mesh.hpp"
#include "progress.hpp"

namespace cardiac::app {
namespace {

struct ValidateOptions {
  std::string name;
  std::filesystem::path out = "results/validation", hearts;
  std::vector<std::string> expectations;
  bool quick = false, quiet = false;
};

void print_checks(const std::vector<Check>& checks) {
  std::size_t width = 0;
  for (const Check& c : checks)
    width = std::max(width, c.case_name.size() + c.quantity.size() + c.method.size() + 2);
  for (const Check& c : checks)
    std::cout << (c.passed() ? "pass  " : "FAIL  ") << std::left << std::setw(static_cast<int>(width) + 2)
              << c.case_name + "/" + c.quantity + " " + c.method << std::setprecision(6) << c.value << " "
              << c.unit << "  [" << c.low << ", " << c.high << "]  reference " << c.reference << ", "
              << std::setprecision(3) << c.wall_time_s << " s\n";
}

void validate(const ValidateOptions& options) {
  std::vector<Expectation> expectations;
  for (const std::string& text : options.expectations) expectations.push_back(parse_expectation(text));
  polyaffine::make_folder(options.out);
  std::vector<Check> checks;
  {
    ProgressLine line(options.quiet);
    ValidationContext context;
    context.quick = options.quick;
    context.out = options.out;
    context.hearts = heart_folder(options.hearts);
    context.left_out = [](const std::string& why) {
      std::cerr << "cardiac validate: left out " << why << '\n';
    };
    context.mesh_ellipsoid = mesh_truncated_ellipsoid;
    context.mesh_box = mesh_box;
    context.mesh_biventricle = mesh_biventricle;
    for (const ValidationCase& one : validation_cases()) {
      if (options.name != "all" && options.name != one.name) continue;
      context.named = options.name == one.name;
      context.progress = [&](const std::string& what, double fraction) {
        line(one.name + ": " + what, fraction);
      };
      const auto found = one.run(context);
      checks.insert(checks.end(), found.begin(), found.end());
    }
  }
  for (const Expectation& expectation : expectations) apply_expectation(expectation, checks);
  polyaffine::write_atomically(options.out / "validation.json", validation_text(checks));
  if (!options.quiet) print_checks(checks);
  if (!all_passed(checks))
    throw polyaffine::ComputationError("validation: a number left its range; see " +
                                       (options.out / "validation.json").string());
}

}  // namespace

void add_validate_command(CLI::App& app) {
  auto* command = app.add_subcommand("validate", "Recompute published and analytic cases and check them.");
  auto options = std::make_shared<ValidateOptions>();
  std::vector<std::string> names;
  std::string what = "all";
  for (const ValidationCase& one : validation_cases()) {
    names.push_back(one.name);
    what += "; " + one.name + ": " + one.what;
  }
  names.emplace_back("all");
  command->add_option("CASE", options->name, what)->required()->check(CLI::IsMember(names));
  command->add_option("--out", options->out, "folder of validation.json and figures")
      ->type_name("DIR")
      ->capture_default_str();
  command
      ->add_option(
          "--hearts", options->hearts,
          "folder of meshes of other origin (default: CARDIAC_HEARTS of the environment, ../shared); "
          "elastodynamics needs its data/arostica2025")
      ->type_name("DIR");
  command->add_option("--expect", options->expectations, "accept another range of a number")
      ->type_name("CASE/QUANTITY=LOW:HIGH")
      ->allow_extra_args(false);
  command->add_flag("--quick", options->quick, "a smaller set that tells whether something broke");
  command->add_flag("--quiet", options->quiet, "no progress, no table");
  command->callback([options] { validate(*options); });
}

}  // namespace cardiac::app
