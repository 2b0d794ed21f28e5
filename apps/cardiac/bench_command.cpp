#include "bench_command.hpp"

#include <filesystem>
#include <iomanip>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <cardiac/anatomy/structured_ellipsoid.hpp>
#include <cardiac/bench/beat_scene.hpp>
#include <cardiac/bench/bench.hpp>
#include <cardiac/bench/bench_figure.hpp>
#include <cardiac/bench/bench_table.hpp>
#include <cardiac/bench/cube_bench.hpp>
#include <cardiac/protocol/build_anatomy.hpp>
#include <polyaffine/core/atomic_file.hpp>

#include "bench_hearts.hpp"
#include "box_mesh.hpp"
#include "ellipsoid_mesh.hpp"
#include "example_data.hpp"
#include "load_mesh.hpp"
#include "progress.hpp"
#include "warnings.hpp"

namespace cardiac::app {
namespace {

struct BenchOptions {
  std::string scene;
  std::filesystem::path out = "results/bench";
  std::vector<std::string> settings;
  std::filesystem::path protocol = "protocols/healthy_lv.toml", hearts;
  std::vector<std::string> presets{"fast", "accurate"};
  bool quick = false, quiet = false;
};

void print_header() {
  std::cout
      << "scene             method      preset    cells/gauss   tets nodes  dofs points  setup s  solve s "
         "  u %    V %   strain   apex\n";
}

void print_row(const BenchRow& row) {
  std::cout << std::left << std::setw(18) << row.scene << std::setw(12) << row.method << std::setw(10)
            << row.preset << std::setw(12) << row.integration << std::right << std::setw(6) << row.mesh_tets
            << std::setw(6) << row.control_nodes << std::setw(6) << row.dofs << std::setw(7)
            << row.integration_points << std::fixed << std::setprecision(2) << std::setw(9) << row.setup_s
            << std::setprecision(4) << std::setw(9) << row.solve_s;
  if (row.converged)
    std::cout << std::setprecision(2) << std::setw(7) << row.errors.displacement_percent << std::setw(7)
              << row.errors.volume_percent << std::setprecision(4) << std::setw(8)
              << row.errors.max_segment_strain << std::setw(8) << row.errors.apex_strain;
  else
    std::cout << "  not converged";
  std::cout << std::endl;
}

// One beat only when it shall be quick, of one ventricle on a coarse mesh of the same shape.
SceneResult beat(const BenchOptions& options) {
  const bool two = options.scene == kBivBeat;
  BeatContext context;
  context.name = options.scene;
  context.heart = two ? "biv" : options.protocol.stem().string();
  context.presets = options.presets;
  context.protocol = [&options, two](std::vector<std::string> settings) {
    if (options.quick) settings.insert(settings.begin(), "time.max_beats=1");
    if (!two) return load_protocol(given_or_example(options.protocol), settings);
    settings.insert(
        settings.begin(),
        "mesh.file=" + std::filesystem::absolute(given_or_example("meshes/healthy_biv_coarse.vtu")).string());
    return load_protocol(given_or_example("protocols/healthy_biv.toml"), settings);
  };
  context.anatomy = [&options, two](const Protocol& protocol) {
    if (options.quick && !two)
      return build_anatomy(structured_ellipsoid(human_lv(), {6, 12, 1}).mesh, protocol);
    check_mesh_file(protocol);
    std::vector<std::string> warnings;
    Anatomy anatomy = load_anatomy(protocol, warnings);
    print_warnings(warnings);
    return anatomy;
  };
  context.settings = options.settings;
  ProgressLine line(options.quiet);
  context.progress = [&](const std::string& what, double fraction) { line(what, fraction); };
  if (!options.quiet) context.on_row = print_row;
  return run_beat_scene(context);
}

void bench(const BenchOptions& options) {
  polyaffine::make_folder(options.out);
  BenchContext context;
  context.quick = options.quick;
  context.mesh_ellipsoid = mesh_truncated_ellipsoid;
  context.mesh_box = mesh_box;
  context.settings = options.settings;
  context.presets = options.presets;
  if (!options.quiet) {
    print_header();
    context.on_row = print_row;
  }
  std::vector<SceneResult> results;
  const auto add = [&](const SceneResult& result) {
    results.push_back(result);
    polyaffine::write_atomically(options.out / "bench.csv", bench_csv(results));
    polyaffine::write_atomically(options.out / "bench.md", bench_markdown(results));
    polyaffine::write_atomically(options.out / "bench.svg", bench_svg(results));
  };
  if (options.scene == kBeat || options.scene == kBivBeat) return add(beat(options));
  const auto chosen = [&](const std::string& name) { return options.scene.empty() || options.scene == name; };
  const auto run = [&](const auto& solve) {
    ProgressLine line(options.quiet);
    context.progress = [&](const std::string& what, double fraction) { line(what, fraction); };
    add(solve(context));
  };
  if (chosen(kCubeBench)) run(run_cube_scene);
  for (const BenchScene& scene : bench_scenes())
    if (chosen(scene.group)) run([&](const BenchContext& c) { return run_scene(scene, c); });
  const HeartSource hearts = heart_source(heart_folder(options.hearts), options.out / "hearts");
  for (const HeartScene& scene : heart_scenes()) {
    if (options.scene != scene.group) continue;
    ProgressLine line(options.quiet);
    context.progress = [&](const std::string& what, double fraction) { line(what, fraction); };
    if (const auto result = run_heart_scene(scene, hearts, context)) add(*result);
  }
}

}  // namespace

void add_bench_command(CLI::App& app) {
  auto* command = app.add_subcommand("bench", "Error against run time of reduced and full-order models.");
  auto options = std::make_shared<BenchOptions>();
  std::vector<std::string> names{kCubeBench};
  for (const BenchScene& scene : bench_scenes()) {
    if (!names.empty() && names.back() == scene.group) continue;
    names.push_back(scene.group);
  }
  for (const HeartScene& scene : heart_scenes())
    if (names.back() != scene.group) names.push_back(scene.group);
  names.emplace_back(kBeat);
  names.emplace_back(kBivBeat);
  command
      ->add_option(
          "SCENE", options->scene,
          "one scene only; without it all of ellipsoids and cubes, not the beats and real hearts, which "
          "take long")
      ->check(CLI::IsMember(names));
  command->add_option("--out", options->out, "folder of bench.csv, bench.md and bench.svg")
      ->type_name("DIR")
      ->capture_default_str();
  command->add_option("--set", options->settings, "a protocol key of the reduced models")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_option("--protocol", options->protocol, "protocol of the beat")
      ->type_name("FILE")
      ->capture_default_str();
  command
      ->add_option("--hearts", options->hearts,
                   "folder of hearts of other origin (default: CARDIAC_HEARTS of the environment, ../shared)")
      ->type_name("DIR");
  command->add_option("--presets", options->presets, "reduced models: fast, accurate, tuned")
      ->delimiter(',')
      ->capture_default_str();
  command->add_flag("--quick", options->quick, "small meshes, fewer models");
  command->add_flag("--quiet", options->quiet, "no progress, no table");
  command->callback([options] { bench(*options); });
}

}  // namespace cardiac::app
