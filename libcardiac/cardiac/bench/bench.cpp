#include <cardiac/bench/bench.hpp>

#include <algorithm>
#include <optional>

#include <cardiac/anatomy/exact_midpoints.hpp>
#include <polyaffine/core/error.hpp>

namespace cardiac {
namespace {

// Solves are repeated until they took this long together, at most so often.
constexpr double kLongEnough_s = 0.5;
constexpr int kRepeats = 5;

struct ModelChoice {
  std::string method, preset, integration;
  std::size_t mesh = 0;
  std::vector<std::string> settings;
};

ModelChoice full_order(int order, std::size_t mesh) {
  return {"fem_p" + std::to_string(order),
          "",
          "",
          mesh,
          {"reduction.method=fem", "reduction.element_order=" + std::to_string(order)}};
}

ModelChoice reduced(const std::string& preset, const std::string& integration, std::size_t mesh) {
  return {"polyaffine",
          preset,
          integration,
          mesh,
          {"reduction.preset=" + preset, "reduction.integration=" + integration}};
}

struct Plan {
  std::vector<double> sizes_mm;     // of the meshes
  std::vector<ModelChoice> models;  // the first one is the reference
};

Plan make_plan(bool quick) {
  Plan plan;
  if (quick) {
    plan.sizes_mm = {3, 2.7};
    plan.models = {full_order(2, 1), full_order(2, 0), full_order(1, 1)};
    for (const char* preset : {"fast", "accurate"}) plan.models.push_back(reduced(preset, "cells", 1));
    return plan;
  }
  plan.sizes_mm = {3, 2.4, 1.56};
  plan.models = {full_order(2, 2), full_order(1, 2)};
  for (const std::size_t mesh : {0, 1})
    for (const int order : {1, 2}) plan.models.push_back(full_order(order, mesh));
  for (const char* preset : {"fast", "accurate"})
    for (const char* integration : {"cells", "gauss"}) plan.models.push_back(reduced(preset, integration, 2));
  return plan;
}

BenchModel::Solution timed_solution(const BenchModel& model) {
  BenchModel::Solution out = model.solve();
  std::vector<double> times{out.solve_s};
  double total = out.solve_s;
  while (total < kLongEnough_s && times.size() < kRepeats) {
    times.push_back(model.solve().solve_s);
    total += times.back();
  }
  std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2), times.end());
  out.solve_s = times[times.size() / 2];
  return out;
}

void fill_speedups(std::vector<BenchRow>& rows) {
  for (BenchRow& row : rows)
    for (const BenchRow& other : rows)
      if (other.method == "fem_p2" && other.mesh_tets == row.mesh_tets && other.converged && row.converged)
        row.speedup_over_fem = other.solve_s / row.solve_s;
}

}  // namespace

SceneResult run_scene(const BenchScene& scene, const BenchContext& context) {
  const Plan plan = make_plan(context.quick);
  SceneResult result{scene.name, scene.title, "", {}};
  std::vector<std::optional<BenchMesh>> meshes(plan.sizes_mm.size());
  std::unique_ptr<BenchModel> reference;
  std::optional<Yardstick> yardstick;
  for (std::size_t m = 0; m < plan.models.size(); ++m) {
    const ModelChoice& choice = plan.models[m];
    context.progress(scene.name + ": " + choice.method + " " + choice.preset,
                     static_cast<double>(m) / static_cast<double>(plan.models.size()));
    auto& mesh = meshes[choice.mesh];
    if (!mesh) {
      mesh.emplace();
      mesh->mesh = context.mesh_ellipsoid(scene.shape, plan.sizes_mm[choice.mesh]);
      mesh->midpoints = exact_midpoints(scene.shape, mesh->mesh);
    }
    std::vector<std::string> settings = choice.settings;
    if (choice.method == "polyaffine")
      settings.insert(settings.end(), context.settings.begin(), context.settings.end());
    auto model = std::make_unique<BenchModel>(scene, *mesh, settings);
    const BenchModel::Solution solution = timed_solution(*model);
    if (m == 0) {
      if (!solution.converged)
        throw polyaffine::ComputationError("bench: the reference solution of " + scene.name +
                                           " did not converge");
      yardstick.emplace(*model, solution.c);
    }
    BenchRow row;
    row.scene = scene.name;
    row.method = choice.method;
    row.preset = choice.preset;
    row.integration = choice.integration;
    row.mesh_tets = mesh->mesh.num_tets();
    row.control_nodes = model->control_nodes();
    row.dofs = model->ventricle().discretisation.num_unknowns;
    row.integration_points = model->ventricle().wall->table().num_points();
    row.setup_s = model->setup_s();
    row.solve_s = solution.solve_s;
    row.load_steps = solution.load_steps;
    row.newton_iterations = solution.newton_iterations;
    row.converged = solution.converged;
    if (solution.converged) {
      row.cavity_ratio = model->cavity_ratio(solution.c);
      row.errors = yardstick->errors(*model, solution.c);
    }
    result.rows.push_back(row);
    context.on_row(row);
    if (m == 0) reference = std::move(model);
  }
  fill_speedups(result.rows);
  const BenchRow& first = result.rows.front();
  result.reference = first.method + " on " + std::to_string(first.mesh_tets) + " tets, " +
                     std::to_string(first.dofs) + " unknowns";
  return result;
}

}  // namespace cardiac
