#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <cardiac/bench/model.hpp>
#include <cardiac/run/errors.hpp>

namespace cardiac {

/// What a beat adds to a row, against the full-order beat.
struct BeatErrors {
  double ef_points = 0, gls_points = 0;  ///< ejection fraction and GLS, differences in points of per cent
  double peak_strain = 0;       ///< largest difference of a peak normal strain (Lagrangian), segments 1–16
  double apex_peak_strain = 0;  ///< the same in segment 17
  double real_time_factor = 0;  ///< solve_s over the simulated time
};

/// One model of one scene: what it is, what it took and how wrong it is.
struct BenchRow {
  std::string scene, method;        ///< method: fem_p1, fem_p2 or polyaffine
  std::string preset, integration;  ///< empty for full order
  std::string settings;  ///< protocol keys that differ from the preset; rings and integration apart
  int mesh_tets = 0, control_nodes = 0, dofs = 0, integration_points = 0;
  double setup_s = 0;       ///< coordinates, segments, functions, integration points, law, matrix pattern
  double solve_s = 0;       ///< the whole path of loads from zero; median of some where one is short
  double cavity_ratio = 0;  ///< deformed over reference volume
  ModelErrors errors;
  std::optional<ModelErrors> same_tets{};  ///< against quadratic elements on the same tets
  double speedup_over_fem = std::numeric_limits<double>::quiet_NaN();
  int load_steps = 0, newton_iterations = 0;
  std::optional<BeatErrors> beat{};
  std::string heart{};              ///< what the mesh is of
  int setup_full_order_solves = 0;  ///< that the set-up of the model needed; 0: untrained
  /// Solutions (of a beat: beats) after which the set-up has paid against quadratic elements on the same
  /// tets.
  double break_even_solves = std::numeric_limits<double>::quiet_NaN();
  bool converged = false;  ///< if not: times and iterations up to the failure, no errors
};

/// The times of quadratic elements over those of the models on the same tets, and what follows from them.
void fill_speedups(std::vector<BenchRow>& rows);

/// The model that the others are compared with, in words.
std::string reference_text(const BenchRow& row);

/// All rows of a scene and the solution they are compared with.
struct SceneResult {
  std::string scene, title, reference;
  std::vector<BenchRow> rows;
};

struct BenchContext {
  bool quick = false;  ///< smaller meshes, fewer models
  std::function<polyaffine::TetMesh(const TruncatedEllipsoid& shape, double size_mm)> mesh_ellipsoid;
  std::function<polyaffine::TetMesh(const polyaffine::Vec3& size_mm, double edge_mm)> mesh_box;
  std::vector<std::string> presets{"fast", "accurate"};  ///< of the reduced models
  std::vector<std::string> settings;  ///< key=value for the reduced models, on top of everything else
  std::function<void(const std::string& what, double fraction)> progress = [](const auto&, double) {};
  std::function<void(const BenchRow&)> on_row = [](const auto&) {};
};

/// Solves a scene by full-order models on several meshes, the finest one being the reference, and by reduced
/// ones, all on one thread. Times are processor times.
SceneResult run_scene(const BenchScene& scene, const BenchContext& context);

}  // namespace cardiac
