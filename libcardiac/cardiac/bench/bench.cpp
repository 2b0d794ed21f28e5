#include <cardiac/bench/bench.hpp>

#include <algorithm>
#include <optional>
#include <variant>

#include <cardiac/anatomy/exact_midpoints.hpp>
#include <cardiac/anatomy/structured_ellipsoid.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/core/single_thread.hpp>

namespace cardiac {
namespace {

// Solves are repeated until they took this long together, at most so often.
constexpr double kLongEnough_s = 0.5;
constexpr int kRepeats = 5;

struct ModelChoice {
  std::string method;
  std::size_t mesh;
  std::vector<std::string> settings;
};

ModelChoice full_order(int order, std::size_t mesh) {
  return {"fem_p" + std::to_string(order),
          mesh,
          {"reduction.method=fem", "reduction.element_order=" + std::to_string(order)}};
}

ModelChoice reduced(const std::string& preset, const std::string& integration, std::size_t mesh) {
  return {"polyaffine", mesh, {"reduction.preset=" + preset, "reduction.integration=" + integration}};
}

// By edge length, or by the cells of a structured mesh.
using MeshChoice = std::variant<double, StructuredCells>;

struct Plan {
  std::vector<MeshChoice> meshes;
  std::vector<ModelChoice> models;  // the first one is the reference
};

Plan make_plan(bool quick) {
  Plan plan;
  if (quick) {
    plan.meshes = {2.7, StructuredCells{3, 6, 1}, StructuredCells{5, 10, 1}};
    plan.models = {full_order(2, 0), full_order(1, 0), full_order(2, 1), full_order(2, 2)};
    for (const char* preset : {"fast", "accurate"}) plan.models.push_back(reduced(preset, "cells", 0));
    return plan;
  }
  plan.meshes = {
      1.56, 2.2, 3.0, StructuredCells{3, 6, 1}, StructuredCells{4, 8, 1}, StructuredCells{6, 12, 1}};
  plan.models = {full_order(2, 0)};
  for (std::size_t mesh = 0; mesh < plan.meshes.size(); ++mesh)
    for (const int order : {1, 2})
      if (mesh > 0 || order == 1) plan.models.push_back(full_order(order, mesh));
  for (const char* preset : {"fast", "accurate"})
    for (const char* integration : {"cells", "gauss"}) plan.models.push_back(reduced(preset, integration, 1));
  return plan;
}

CurvedMesh make_mesh(const BenchScene& scene, const MeshChoice& choice, const BenchContext& context) {
  if (const auto* cells = std::get_if<StructuredCells>(&choice))
    return structured_ellipsoid(scene.shape, *cells);
  CurvedMesh out{context.mesh_ellipsoid(scene.shape, std::get<double>(choice)), {}};
  out.midpoints = exact_midpoints(scene.shape, out.mesh);
  return out;
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

BenchRow make_row(const BenchScene& scene, const std::string& method, const BenchModel& model,
                  const BenchModel::Solution& solution, const Yardstick& yardstick) {
  BenchRow row;
  row.scene = scene.name;
  row.method = method;
  row.preset = model.preset();
  row.integration = model.integration();
  row.mesh_tets = model.anatomy().mesh.num_tets();
  row.control_nodes = model.control_nodes();
  row.dofs = model.ventricle().discretisation.num_unknowns;
  row.integration_points = model.ventricle().wall->table().num_points();
  row.setup_s = model.setup_s();
  row.solve_s = solution.solve_s;
  row.load_steps = solution.load_steps;
  row.newton_iterations = solution.newton_iterations;
  row.converged = solution.converged;
  if (!solution.converged) return row;
  row.cavity_ratio = model.cavity_ratio(solution.c);
  row.errors = yardstick.errors(model, solution.c);
  return row;
}

void fill_speedups(std::vector<BenchRow>& rows) {
  for (BenchRow& row : rows)
    for (const BenchRow& other : rows)
      if (other.method == "fem_p2" && other.mesh_tets == row.mesh_tets && other.converged && row.converged)
        row.speedup_over_fem = other.solve_s / row.solve_s;
}

}  // namespace

SceneResult run_scene(const BenchScene& scene, const BenchContext& context) {
  const polyaffine::SingleThread single_thread;
  const Plan plan = make_plan(context.quick);
  SceneResult result{scene.name, scene.title, "", {}};
  std::vector<std::optional<CurvedMesh>> meshes(plan.meshes.size());
  std::unique_ptr<BenchModel> reference;
  std::optional<Yardstick> yardstick;
  for (const ModelChoice& choice : plan.models) {
    context.progress(scene.name + ": " + choice.method,
                     static_cast<double>(result.rows.size()) / static_cast<double>(plan.models.size()));
    auto& mesh = meshes[choice.mesh];
    if (!mesh) mesh = make_mesh(scene, plan.meshes[choice.mesh], context);
    std::vector<std::string> settings = choice.settings;
    if (choice.method == "polyaffine")
      settings.insert(settings.end(), context.settings.begin(), context.settings.end());
    auto model = std::make_unique<BenchModel>(scene, *mesh, settings);
    const BenchModel::Solution solution = timed_solution(*model);
    if (!reference) {
      if (!solution.converged)
        throw polyaffine::ComputationError("bench: the reference solution of " + scene.name +
                                           " did not converge");
      yardstick.emplace(*model, solution.c);
    }
    result.rows.push_back(make_row(scene, choice.method, *model, solution, *yardstick));
    context.on_row(result.rows.back());
    if (!reference) reference = std::move(model);
  }
  fill_speedups(result.rows);
  const BenchRow& first = result.rows.front();
  result.reference = first.method + " on " + std::to_string(first.mesh_tets) + " tets, " +
                     std::to_string(first.dofs) + " unknowns";
  return result;
}

}  // namespace cardiac
