#include <cardiac/bench/bench.hpp>

#include <algorithm>
#include <array>
#include <optional>
#include <variant>

#include <cardiac/anatomy/exact_midpoints.hpp>
#include <cardiac/anatomy/structured_ellipsoid.hpp>
#include <cardiac/training/tuned_model.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/core/single_thread.hpp>

namespace cardiac {
namespace {

struct ModelChoice {
  std::string method;
  std::size_t mesh;
  std::vector<std::string> settings;
  std::string own{};     // a further setting that the row tells
  std::string preset{};  // of a reduced model
};

ModelChoice full_order(int order, std::size_t mesh) {
  return {"fem_p" + std::to_string(order),
          mesh,
          {"reduction.method=fem", "reduction.element_order=" + std::to_string(order)}};
}

ModelChoice reduced(const std::string& preset, const std::string& ring_nodes, std::size_t mesh,
                    const std::string& integration = "cells") {
  return {"polyaffine",
          mesh,
          {"reduction.preset=" + preset, "reduction.ring_nodes=" + ring_nodes,
           "reduction.integration=" + integration},
          {},
          preset};
}

// The apex node and these: 5, 17 (one a segment), 29 and 61 control nodes.
constexpr std::array kRingNodes{"[4]", "[4,6,6]", "[4,6,6,6,6]", "[6,8,8,8,10,10,10]"};
constexpr const char* kSegments = kRingNodes[1];

// By edge length on Land's ellipsoid (as fine on another), or by the cells of a structured mesh.
using MeshChoice = std::variant<double, StructuredCells>;

struct Plan {
  std::vector<MeshChoice> meshes;
  std::vector<ModelChoice> models;  // the first one is the reference
};

// The same mesh and functions at six compressibilities, full order for each.
Plan compliance_plan() {
  Plan plan;
  plan.meshes = {StructuredCells{8, 16, 2}};
  plan.models = {full_order(2, 0), reduced("fast", kSegments, 0), reduced("accurate", kSegments, 0)};
  return plan;
}

Plan quick_plan() {
  Plan plan;
  plan.meshes = {StructuredCells{12, 24, 2}, StructuredCells{3, 6, 1}, StructuredCells{5, 10, 1}};
  plan.models = {full_order(2, 0), full_order(1, 0), full_order(2, 1), full_order(2, 2)};
  for (const char* preset : {"fast", "accurate"}) plan.models.push_back(reduced(preset, kSegments, 0));
  return plan;
}

Plan whole_plan() {
  Plan plan;
  plan.meshes = {StructuredCells{16, 32, 3}, 2.2,
                 StructuredCells{3, 6, 1},   StructuredCells{4, 8, 1},
                 StructuredCells{6, 12, 1},  StructuredCells{8, 16, 2}};
  plan.models = {full_order(2, 0)};
  for (std::size_t mesh = 0; mesh < plan.meshes.size(); ++mesh)
    for (const int order : {1, 2})
      if (mesh > 0 || order == 1) plan.models.push_back(full_order(order, mesh));
  for (const char* preset : {"fast", "accurate"}) {
    for (const char* nodes : kRingNodes) plan.models.push_back(reduced(preset, nodes, 1));
    plan.models.push_back(reduced(preset, kSegments, 1, "gauss"));
  }
  // From affine frames with the accurate pressures to its richest functions.
  for (const char* functions : {"[]", "[\"tt\"]", "[\"tt\",\"lt\",\"ct\"]"}) {
    plan.models.push_back(reduced("accurate", kSegments, 1));
    plan.models.back().own = std::string("reduction.enrichment=") + functions;
  }
  return plan;
}

// The presets on another heart.
Plan heart_plan() {
  Plan plan;
  plan.meshes = {StructuredCells{16, 32, 3}, 2.2};
  plan.models = {full_order(2, 0), full_order(2, 1), reduced("fast", kSegments, 1),
                 reduced("accurate", kSegments, 1)};
  return plan;
}

Plan make_plan(const BenchScene& scene, const BenchContext& context) {
  if (scene.group == kCompliance) return compliance_plan();
  Plan plan = context.quick ? quick_plan() : scene.other_heart ? heart_plan() : whole_plan();
  const auto asked_for = [&](const std::string& preset) {
    return std::ranges::find(context.presets, preset) != context.presets.end();
  };
  std::erase_if(plan.models, [&](const ModelChoice& choice) {
    return !choice.preset.empty() && !asked_for(choice.preset);
  });
  if (asked_for("tuned"))
    plan.models.push_back({"polyaffine", context.quick ? 0UL : 1UL, {"reduction.preset=tuned"}, {}, "tuned"});
  return plan;
}

CurvedMesh ellipsoid_mesh(const TruncatedEllipsoid& shape, const MeshChoice& choice,
                          const BenchContext& context) {
  if (const auto* cells = std::get_if<StructuredCells>(&choice)) return structured_ellipsoid(shape, *cells);
  const double edge = std::get<double>(choice) * shape.endo_long_mm / land_ellipsoid().endo_long_mm;
  CurvedMesh out{context.mesh_ellipsoid(shape, edge), {}};
  out.midpoints = exact_midpoints(shape, out.mesh);
  return out;
}

CurvedMesh make_mesh(const BenchScene& scene, const MeshChoice& choice, const BenchContext& context) {
  CurvedMesh out = ellipsoid_mesh(scene.shape, choice, context);
  if (!scene.to_wall) return out;
  Points points = out.mesh.points();
  for (Eigen::Index i = 0; i < points.cols(); ++i) points.col(i) = scene.to_wall(points.col(i));
  for (auto& [edge, X] : out.midpoints) X = scene.to_wall(X);
  out.mesh = polyaffine::TetMesh(points, out.mesh.tets(), out.mesh.regions(),
                                 {out.mesh.boundary(), out.mesh.boundary_labels()});
  return out;
}

BenchRow make_row(const BenchScene& scene, const std::string& method, const BenchModel& model,
                  const BenchModel::Solution& solution, const Yardstick& yardstick,
                  const Yardstick* same_tets) {
  BenchRow row;
  row.scene = scene.name;
  row.heart = scene.to_wall       ? "asymmetric_ellipsoid"
              : scene.other_heart ? "human_ellipsoid"
                                  : "land_ellipsoid";
  row.method = method;
  row.preset = model.preset();
  row.integration = model.integration();
  row.mesh_tets = model.anatomy().mesh.num_tets();
  row.control_nodes = model.control_nodes();
  row.dofs = model.ventricle().discretisation.num_unknowns;
  row.integration_points = model.ventricle().wall->table().num_points();
  row.setup_s = model.setup_s();
  row.setup_full_order_solves = full_order_solves(model.ventricle().tuned.get());
  row.solve_s = solution.solve_s;
  row.load_steps = solution.load_steps;
  row.newton_iterations = solution.newton_iterations;
  row.converged = solution.converged;
  if (!solution.converged) return row;
  row.cavity_ratio = model.cavity_ratio(solution.c);
  row.errors = yardstick.errors(model.ventricle(), solution.c);
  if (same_tets) row.same_tets = same_tets->errors(model.ventricle(), solution.c);
  return row;
}

}  // namespace

void fill_speedups(std::vector<BenchRow>& rows) {
  for (BenchRow& row : rows)
    for (const BenchRow& other : rows)
      if (other.method == "fem_p2" && other.mesh_tets == row.mesh_tets && other.converged && row.converged) {
        row.speedup_over_fem = other.solve_s / row.solve_s;
        if (row.method == "polyaffine" && row.solve_s < other.solve_s)
          row.break_even_solves = row.setup_s / (other.solve_s - row.solve_s);
      }
}

std::string reference_text(const BenchRow& row) {
  return row.method + " on " + std::to_string(row.mesh_tets) + " tets, " + std::to_string(row.dofs) +
         " unknowns";
}

SceneResult run_scene(const BenchScene& scene, const BenchContext& context) {
  const polyaffine::SingleThread single_thread;
  const Plan plan = make_plan(scene, context);
  SceneResult result{scene.name, scene.title, "", {}};
  std::vector<std::optional<CurvedMesh>> meshes(plan.meshes.size());
  // The solution on quadratic elements of a mesh, for the models on its tets; the first is the reference.
  struct Truth {
    std::unique_ptr<BenchModel> model;
    std::optional<Yardstick> yardstick;
  };
  std::vector<Truth> truths(plan.meshes.size());
  const auto& yardstick = truths[plan.models.front().mesh].yardstick;
  for (const ModelChoice& choice : plan.models) {
    context.progress(scene.name + ": " + choice.method,
                     static_cast<double>(result.rows.size()) / static_cast<double>(plan.models.size()));
    auto& mesh = meshes[choice.mesh];
    if (!mesh) mesh = make_mesh(scene, plan.meshes[choice.mesh], context);
    std::vector<std::string> settings = choice.settings;
    std::string told = choice.own;
    if (!choice.own.empty()) settings.push_back(choice.own);
    if (!choice.preset.empty())
      for (const std::string& setting : context.settings) {
        settings.push_back(setting);
        told += (told.empty() ? "" : "; ") + setting;
      }
    auto model = std::make_unique<BenchModel>(scene, *mesh, settings);
    const BenchModel::Solution solution = BenchModel::timed([&] { return model->solve(); });
    Truth& truth = truths[choice.mesh];
    const bool is_truth = choice.method == "fem_p2" && solution.converged;
    if (is_truth) truth.yardstick.emplace(model->ventricle(), solution.c);
    if (!yardstick)
      throw polyaffine::ComputationError("bench: the reference solution of " + scene.name +
                                         " did not converge");
    result.rows.push_back(make_row(scene, choice.method, *model, solution, *yardstick,
                                   truth.yardstick ? &*truth.yardstick : nullptr));
    result.rows.back().settings = told;
    context.on_row(result.rows.back());
    if (is_truth) truth.model = std::move(model);
  }
  fill_speedups(result.rows);
  result.reference = reference_text(result.rows.front());
  return result;
}

}  // namespace cardiac
