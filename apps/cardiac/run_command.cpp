#include "run_command.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <memory>
#include <span>
#include <sstream>

#include <cardiac/protocol/describe.hpp>
#include <cardiac/protocol/names.hpp>
#include <cardiac/protocol/plan.hpp>
#include <cardiac/report/figures.hpp>
#include <cardiac/report/filling.hpp>
#include <cardiac/report/haemodynamics_text.hpp>
#include <cardiac/report/page.hpp>
#include <cardiac/report/summary.hpp>
#include <cardiac/report/tables.hpp>
#include <cardiac/run/checkpoint.hpp>
#include <cardiac/run/simulate.hpp>
#include <cardiac/run/unload.hpp>
#include <cardiac/run/verification.hpp>
#include <cardiac/scene/given_key.hpp>
#include <cardiac/training/tuned_model.hpp>
#include <nlohmann/json.hpp>
#include <polyaffine/core/atomic_file.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/core/fnv1a.hpp>
#include <polyaffine/mesh/digest.hpp>

#include "example_data.hpp"
#include "heart_model.hpp"
#include "interrupt.hpp"
#include "load_mesh.hpp"
#include "progress.hpp"
#include "result_folder.hpp"
#include "run_files.hpp"
#include "wall_figure.hpp"
#include "warnings.hpp"

namespace cardiac::app {
namespace {

struct RunOptions {
  std::string protocol;
  std::string model;
  std::string out;
  std::string method;
  std::vector<std::string> overrides;
  std::string identity;  // the protocol as resolved, JSON
  bool verify = false, dry_run = false, resume = false, quiet = false, verbose = false, force = false;
};

void print_plan(const std::vector<PlanItem>& items) {
  std::size_t width = 0;
  for (const PlanItem& item : items) width = std::max(width, item.part.size());
  for (const PlanItem& item : items) {
    std::cout << std::left << std::setw(static_cast<int>(width) + 2) << item.part
              << (item.built ? "built     " : "left out  ") << item.why << '\n';
  }
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// The drawing; none where nothing was computed.
std::string write_wall_figure(const Ventricle& ventricle, const Protocol& protocol, const HeartPath& path,
                              const BeatResult& result, const std::filesystem::path& out) {
  if (path.steps.empty()) return "";
  const Figure wall = wall_figure(ventricle, protocol, path, result);
  polyaffine::write_atomically(out / wall.file, wall.svg);
  return wall.svg;
}

// Tables, figures and meshes; the drawing of the wall for the page.
std::string write_results(const Ventricle& ventricle, const Protocol& protocol, const HeartPath& path,
                          const BeatResult& result, const RunInfo& info, const std::filesystem::path& out) {
  if (protocol.output.mesh_series && !path.outputs.empty())
    write_mesh_series(ventricle, protocol, path, result, out);
  std::string wall;
  if (protocol.output.figures) {
    write_figures(result, info, out);
    wall = write_wall_figure(ventricle, protocol, path, result, out);
  }
  if (protocol.output.tables) write_tables(result, info, out);
  return wall;
}

// What tells the times of the run, and with it what they are.
void write_summary(const Protocol& protocol, BeatResult& result, const RunInfo& info,
                   const std::filesystem::path& out, const std::string& wall,
                   std::chrono::steady_clock::time_point start) {
  result.wall_total_s = seconds_since(start);
  polyaffine::write_atomically(out / "summary.json", summary_text(result, info));
  if (protocol.output.figures) write_report_page(result, info, out, wall);
}

// Full order at end diastole and end systole; told on the terminal, and ended by a signal. Returns its
// seconds.
double verify(const Ventricle& ventricle, const Protocol& protocol, const HeartPath& path, BeatResult& result,
              const InterruptGuard& interrupt, bool quiet) {
  const auto start = std::chrono::steady_clock::now();
  ProgressLine line(quiet, "about");
  result.verification = verify_path(ventricle, protocol, path, [&](const std::string& what, double fraction) {
    if (!interrupt.reason().empty())
      throw polyaffine::ComputationError("verification: " + interrupt.reason() +
                                         "; the results of the run itself are whole");
    line(what, fraction);
  });
  return seconds_since(start);
}

// Three digits.
std::string seconds_text(double seconds) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(seconds < 10 ? 2 : seconds < 100 ? 1 : 0) << seconds << " s";
  return text.str();
}

void print_result(const BeatResult& result, double verification_s, const std::filesystem::path& out) {
  if (result.unloading) std::cout << unloading_text(*result.unloading) << '\n';
  std::cout << std::fixed << std::setprecision(1);
  for (const VentricleSummary& v : result.ventricles) {
    if (!result.has_beat && !v.samples.empty() && std::isfinite(v.samples.back().volume_mL))
      std::cout << v.name << ": volume " << v.samples.back().volume_mL << " mL at "
                << v.samples.back().pressure_mmHg << " mmHg\n";
    if (!result.has_beat || !result.completed) continue;
    std::cout << v.name << ": EDV " << v.edv_mL << " mL, ESV " << v.esv_mL << " mL, EF " << v.ef_percent
              << " %, peak pressure " << v.peak_pressure_mmHg << " mmHg, EDP " << v.edp_mmHg << " mmHg\n";
    for (const std::string& line : haemodynamics_lines(v)) std::cout << v.name << ": " << line << '\n';
  }
  if (result.completed)
    for (const std::string& line : balance_lines(result)) std::cout << line << '\n';
  if (result.has_beat && result.completed)
    std::cout << "strain at end systole: GLS " << result.strain.gls_percent << " %, GCS "
              << result.strain.gcs_percent << " %, GRS " << result.strain.grs_percent << " %, twist "
              << result.strain.twist_deg << " deg\n";
  if (!result.estimated_errors.empty()) {
    std::cout << "error by the model's own estimate:" << std::setprecision(2);
    for (const EstimatedError& e : result.estimated_errors)
      std::cout << ' ' << e.instant << ' ' << e.displacement_percent << " %";
    std::cout << " of displacement\n" << std::setprecision(1);
  }
  for (const VerificationInstant& v : result.verification)
    std::cout << "against full order at " << v.instant << ": displacement " << v.displacement_error_percent
              << " %, volume " << v.volume_error_percent << " %, segment strain " << std::setprecision(3)
              << v.max_segment_strain_error << std::setprecision(1) << '\n';
  std::cout << seconds_text(result.simulated_time_s) << " of the heart: set-up "
            << seconds_text(result.wall_setup_s) << ", solve " << seconds_text(result.wall_solve_s);
  if (!result.verification.empty()) std::cout << ", verification " << seconds_text(verification_s);
  std::cout << ", output " << seconds_text(result.wall_output_s) << ", whole "
            << seconds_text(result.wall_total_s) << "; results in " << out.string() << '\n';
}

// Where the time of the beats went.
void print_timing(const BeatResult& result) {
  const SolveCost& c = result.cost;
  const auto line = [](const char* what, long calls, double seconds) {
    std::cout << "  " << std::left << std::setw(16) << what << std::right << std::setw(7)
              << (calls > 0 ? std::to_string(calls) : "") << std::setw(9) << std::fixed
              << std::setprecision(3) << seconds << " s\n";
  };
  std::cout << result.time_steps << " time steps, " << c.error_test_failures << " repeated for accuracy, "
            << c.convergence_failures << " for convergence\n";
  line("filling", 0, c.filling_s);
  line("residuals", c.residuals, c.residual_s);
  line("tangents", c.factorisations, c.tangent_s);
  line("factorisations", c.factorisations, c.factorisation_s);
  line("linear solves", c.linear_solves, c.linear_solve_s);
  line("rest", 0,
       result.wall_solve_s - c.filling_s - c.residual_s - c.tangent_s - c.factorisation_s - c.linear_solve_s);
}

// The checkpoint in the folder; none, and said so, where there is none.
std::shared_ptr<const Checkpoint> last_checkpoint(const std::filesystem::path& file,
                                                  const CheckpointOrigin& origin) {
  if (std::filesystem::exists(file)) return std::make_shared<const Checkpoint>(read_checkpoint(file, origin));
  print_warnings({"no " + file.string() + ": from the beginning"});
  return nullptr;
}

CheckpointOrigin origin_of(const Scene& scene, const std::string& protocol_json) {
  std::string mesh = polyaffine::digest(scene.heart->mesh);
  if (scene.fibres && scene.fibres->source == scene::FibreSource::file)
    mesh += ", fibres " + polyaffine::digest(polyaffine::Matrix(tet_fibres(*scene.heart, *scene.fibres)));
  if (const std::string given = given_key(scene); !given.empty()) {
    polyaffine::Fnv1a sum;
    sum.add(std::span<const char>(given));
    mesh += ", tables and network " + std::to_string(sum.value());
  }
  return {CARDIAC_VERSION, protocol_json, std::move(mesh)};
}

// How the run is watched, stopped and kept for --resume in its folder.
RunControl control_of(const Scene& scene, const RunOptions& options, const std::filesystem::path& out,
                      const InterruptGuard& interrupt, ProgressLine& line) {
  const std::filesystem::path file = out / "checkpoint.json";
  const CheckpointOrigin origin = origin_of(scene, options.identity);
  RunControl control;
  control.progress = [&line](const std::string& what, double fraction) { line(what, fraction); };
  control.stop_reason = [&interrupt] { return interrupt.reason(); };
  control.on_checkpoint = [file, origin](const Checkpoint& at) {
    polyaffine::write_atomically(file, checkpoint_text(at, origin));
  };
  control.on_distrust = [file] { std::filesystem::remove(file); };
  control.keep_absurd = options.force;
  if (options.resume) control.resume = last_checkpoint(file, origin);
  return control;
}

void run(RunOptions options) {
  const auto start = std::chrono::steady_clock::now();
  if (!options.method.empty()) options.overrides.push_back("reduction.method=" + options.method);
  if (options.protocol.empty() == options.model.empty())
    throw polyaffine::InputError(options.model.empty()
                                     ? "PROTOCOL is required (or --model HEART.model)"
                                     : "run: found PROTOCOL and --model, expected one of them");
  Protocol protocol = options.model.empty() ? load_input(given_or_example(options.protocol),
                                                         options.overrides, {.insist = options.force})
                                            : load_model(options.model, options.overrides);
  if (options.verify && protocol.contraction && protocol.contraction->feels_fibre())
    throw polyaffine::InputError(
        "--verify: found contraction.model = " + protocol::name_of(protocol.contraction->model) +
        ", whose tension depends on how the wall has moved, and --verify solves equilibria; expected a run "
        "with --set reduction.method=fem beside this one");
  if (protocol.output.mesh_series && !writes_mesh_series()) {
    protocol.output.mesh_series = false;
    protocol.warnings.push_back(
        "output.mesh_series: this build writes no .vtu files (CMake option POLYAFFINE_WITH_VTK): left out");
  }
  const std::vector<PlanItem> items = plan(protocol, options.verify);
  print_warnings(protocol.warnings);
  if (options.dry_run) return print_plan(items);
  const std::filesystem::path out =
      options.out.empty()
          ? std::filesystem::path("results") /
                std::filesystem::path(options.model.empty() ? options.protocol : options.model).stem()
          : std::filesystem::path(options.out);
  polyaffine::make_folder(out);
  if (protocol.mesh.file && options.model.empty()) check_not_a_result(mesh_path(protocol), out);

  options.identity = resolved_json(protocol).dump();
  const InterruptGuard interrupt;
  double setup_s = 0;
  auto output_start = start;
  Outcome outcome;
  {
    ProgressLine line(options.quiet);
    RunControl control = control_of(protocol, options, out, interrupt, line);
    control.on_round = [&options](const TuningRound& round) {
      if (options.quiet) return;
      std::cout << "tuning: " << round.full_order_solves << " full-order solves, " << round.unknowns
                << " unknowns, " << round.points << " points, " << std::fixed << std::setprecision(1)
                << round.seconds << " s: " << std::setprecision(2) << round.protocol.displacement_percent
                << " % off in the worst load held out, " << round.segments.displacement_percent
                << " % with other segments" << std::endl;
    };
    control.on_built = [&] {
      setup_s = seconds_since(start);
      remove_old_results(out);
    };
    control.on_solved = [&output_start] { output_start = std::chrono::steady_clock::now(); };
    outcome = simulate(protocol, control);
  }
  auto& [ventricle, nodes, path, result] = outcome;
  if (protocol.imaged) static_cast<Scene&>(protocol) = unloaded_scene(protocol, ventricle.anatomy);
  result.wall_setup_s = setup_s;
  result.plan = items;
  print_warnings(result.warnings);
  result.warnings.insert(result.warnings.begin(), protocol.warnings.begin(), protocol.warnings.end());
  const RunInfo info{CARDIAC_VERSION, options.identity, 0};
  const std::string wall = write_results(ventricle, protocol, path, result, info, out);
  result.wall_output_s = seconds_since(output_start);
  write_summary(protocol, result, info, out, wall, start);
  double verification_s = 0;
  if (options.verify && result.completed && protocol.reduction.method == protocol::Method::polyaffine) {
    verification_s = verify(ventricle, protocol, path, result, interrupt, options.quiet);
    write_summary(protocol, result, info, out, wall, start);
  }
  if (!options.quiet) print_result(result, verification_s, out);
  if (options.verbose && result.has_beat) print_timing(result);
  if (!result.completed)
    throw polyaffine::ComputationError(
        result.stop_reason + "; what was computed is in " + out.string() +
        (path.completed ? " (--force takes it for a result)" : "") +
        (interrupt.reason().empty() || path.completed || !protocol.circulation ? "" : ", --resume goes on"));
}

}  // namespace

void add_run_command(CLI::App& app) {
  auto* command = app.add_subcommand("run", "Compute the heart beat of a protocol on a ventricle mesh.");
  auto options = std::make_shared<RunOptions>();
  command->add_option("PROTOCOL", options->protocol, "protocol file (.toml)");
  command
      ->add_option("--model", options->model,
                   "instead of a protocol: a model file of cardiac reduce, which holds all that a run needs")
      ->type_name("HEART.model");
  command->add_option("--out", options->out, "result directory (default: results/ and the protocol's name)")
      ->type_name("DIR");
  command->add_option("--set", options->overrides, "override a protocol key; the value in TOML")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_option("--method", options->method, "polyaffine (reduced) or fem (full order)")
      ->check(CLI::IsMember({"polyaffine", "fem"}));
  command->add_flag("--verify", options->verify, "also solve full order at end diastole and end systole");
  command->add_flag("--dry-run", options->dry_run, "check the input, print what would be built, and stop");
  command->add_flag("--resume", options->resume,
                    "go on from the checkpoint.json of an interrupted run in the result directory");
  command->add_flag("--force", options->force,
                    "take a wall of any size and an absurd result, with a warning instead of status 2 and 1");
  command->add_flag("--verbose", options->verbose, "also print where the time of the solve went");
  command->add_flag("--quiet", options->quiet, "no progress, no summary; warnings go to stderr in any case");
  command->callback([options] { run(*options); });
}

}  // namespace cardiac::app
