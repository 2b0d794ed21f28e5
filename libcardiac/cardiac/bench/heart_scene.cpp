#include <cardiac/bench/heart_scene.hpp>

#include <memory>
#include <utility>

#include <cardiac/bench/model.hpp>
#include <cardiac/protocol/names.hpp>
#include <cardiac/run/build_ventricle.hpp>
#include <cardiac/run/tuned_model.hpp>
#include <cardiac/scene/presets.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/core/single_thread.hpp>

namespace cardiac {
namespace {

using Settings = std::vector<std::string>;

const Settings kFullOrder{"reduction.method=fem", "reduction.element_order=2"};

struct HeartModel {
  Ventricle ventricle;
  scene::Reduction reduction;
  std::vector<WallLoad> path;
  std::unique_ptr<polyaffine::LinearSystem> linear;
  BenchModel::Solution solution;
  double setup_s = 0;

  bool reduced() const { return ventricle.discretisation.frame_basis != nullptr; }
};

HeartModel solve(const HeartScene& scene, const Protocol& protocol) {
  HeartModel out;
  out.reduction = protocol.reduction;
  const double start = polyaffine::processor_seconds();
  out.ventricle = build_ventricle(protocol.heart, protocol, protocol.reduction.method);
  const double left = scene.left_mmHg * kPa_per_mmHg, right = scene.right_mmHg * kPa_per_mmHg;
  WallLoad load;
  load.pressures_kPa =
      out.ventricle.cavities.size() > 1 ? polyaffine::Vector{{left, right}} : polyaffine::Vector{{left}};
  if (out.ventricle.contraction) load.tension = scene.tension_kPa * out.ventricle.contraction->scale;
  out.path = {load};
  out.linear = loaded_ventricle(out.ventricle, load).make_linear();
  out.setup_s = polyaffine::processor_seconds() - start;
  out.solution = BenchModel::timed([&] { return BenchModel::solve(out.ventricle, out.path, *out.linear); });
  return out;
}

BenchRow make_row(const HeartScene& scene, const HeartModel& model, const Yardstick& yardstick,
                  int reference_tets) {
  BenchRow row;
  row.scene = scene.name;
  row.heart = scene.heart;
  row.method = model.reduced() ? "polyaffine" : "fem_p2";
  if (model.reduced()) {
    row.preset = protocol::name_of(model.reduction.preset);
    row.integration = protocol::name_of(model.reduction.integration);
    row.control_nodes = model.ventricle.discretisation.layout.num_nodes();
  }
  row.mesh_tets = model.ventricle.anatomy->mesh.num_tets();
  row.dofs = model.ventricle.discretisation.num_unknowns;
  row.integration_points = model.ventricle.wall->table().num_points();
  row.setup_s = model.setup_s + learning_seconds(model.ventricle.tuned.get());
  row.setup_full_order_solves = full_order_solves(model.ventricle.tuned.get());
  row.solve_s = model.solution.solve_s;
  row.load_steps = model.solution.load_steps;
  row.newton_iterations = model.solution.newton_iterations;
  row.converged = model.solution.converged;
  if (!row.converged) return row;
  const polyaffine::Vector rest = polyaffine::Vector::Zero(model.ventricle.num_coefficients());
  row.cavity_ratio = model.ventricle.cavity_volume(model.solution.c) / model.ventricle.cavity_volume(rest);
  row.errors = yardstick.errors(model.ventricle, model.solution.c);
  if (row.mesh_tets == reference_tets) row.same_tets = row.errors;
  return row;
}

Settings with(Settings settings, const Settings& more) {
  settings.insert(settings.end(), more.begin(), more.end());
  return settings;
}

void add_filled_and_systolic(const std::string& group, const std::string& title,
                             std::vector<HeartScene>& scenes) {
  scenes.push_back({group, group + "_passive", title + ", filled", group, 10, 5, 0});
  scenes.push_back({group, group + "_systole", title + ", end systole", group, 90, 20, 90});
}

}  // namespace

const std::vector<HeartScene>& heart_scenes() {
  static const std::vector<HeartScene> scenes = [] {
    std::vector<HeartScene> out{
        {"biv_passive", "biv_passive", "Two ventricles, filled", "biv", 10, 5, 0},
        {"biv_systole", "biv_systole", "Two ventricles, end systole", "biv", 90, 20, 90},
        {"biv_scar",
         "biv_scar",
         "Two ventricles, end systole with a scar",
         "biv",
         90,
         20,
         90,
         {"region=[{segments=[7, 8], tension_factor=0.2}]"}}};
    add_filled_and_systolic("lv_real", "A ventricle of another program", out);
    add_filled_and_systolic("lv_arostica", "The left ventricle of Aróstica et al. 2025", out);
    add_filled_and_systolic("biv_arostica", "The two ventricles of Aróstica et al. 2025", out);
    add_filled_and_systolic("papillary", "A ventricle with two papillary muscles", out);
    return out;
  }();
  return scenes;
}

std::optional<SceneResult> run_heart_scene(const HeartScene& scene, const HeartSource& source,
                                           const BenchContext& context) {
  const polyaffine::SingleThread single_thread;
  context.progress(scene.name + ": fem_p2", 0);
  const auto full = source.input(scene.heart, with(scene.settings, kFullOrder));
  if (!full) return std::nullopt;
  const HeartModel reference = solve(scene, *full);
  if (!reference.solution.converged)
    throw polyaffine::ComputationError("bench: the reference solution of " + scene.name +
                                       " did not converge");
  const Yardstick yardstick(reference.ventricle, reference.solution.c);
  SceneResult out{scene.name, scene.title, "", {}};
  const auto add = [&](const HeartModel& model, const std::string& settings = "") {
    out.rows.push_back(make_row(scene, model, yardstick, reference.ventricle.anatomy->mesh.num_tets()));
    out.rows.back().settings = settings;
    context.on_row(out.rows.back());
  };
  add(reference);
  // A tuned model is learned from the heart as it is without the changes of the scene (a scar).
  const auto learned = [&](const Protocol& protocol) {
    const auto plain = source.input(scene.heart, with({"reduction.preset=tuned"}, context.settings));
    return plain ? tuned_model(protocol.heart, *plain) : nullptr;
  };
  context.progress(scene.name + ": fem_p2 on a coarse mesh", 0.4);
  if (const auto coarse = source.coarse(scene.heart, with(scene.settings, kFullOrder)))
    add(solve(scene, *coarse));
  std::string told;
  for (const std::string& setting : context.settings) told += (told.empty() ? "" : "; ") + setting;
  for (const std::string& preset : context.presets) {
    context.progress(scene.name + ": " + preset, 0.6);
    const Settings settings = with(with(scene.settings, {"reduction.preset=" + preset}), context.settings);
    auto reduced = source.input(scene.heart, settings);
    if (!reduced) continue;
    if (is_tuned(*reduced)) reduced->tuned = learned(*reduced);
    add(solve(scene, *reduced), told);
  }
  fill_speedups(out.rows);
  out.reference = reference_text(out.rows.front());
  return out;
}

}  // namespace cardiac
