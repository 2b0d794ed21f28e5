#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <cardiac/training/error_check.hpp>
#include <cardiac/training/nested_rule.hpp>
#include <cardiac/training/training_states.hpp>

namespace cardiac {

/// What a tuned model is learned from, besides its heart and scene.
struct TuningPlan {
  std::vector<TrainingLoad> path;  ///< what the scene asks; the first is raised from zero
  /// Changes of the regions whose linear answers in a state of the path, by its name, are learned too.
  struct Changes {
    std::string of;
    std::vector<scene::RegionOverride> regions;
  };
  std::vector<Changes> neighbours;
  /// Changes too large for that: the equilibria with them are learned.
  std::vector<Changes> far_neighbours;
  /// What the model of a round is held against, other loads each time.
  std::function<std::vector<TrainingLoad>(int round)> held_out;
};

/// How far a model is off in the worst of some loads.
struct WorstLoad {
  double displacement_percent = 0;  ///< L2 over the wall
  double volume_percent = 0;        ///< the largest of any load and cavity
  double best_percent = 0;          ///< displacement of the function of the model's space that is nearest
  std::string load;
};

/// One round of a tuning: what the model was, and how far off in loads held out.
struct TuningRound {
  int full_order_solves = 0, modes = 0, pressures = 0, unknowns = 0, points = 0;
  double seconds = 0;  ///< since the tuning began
  WorstLoad protocol;  ///< of loads between and about those of the scene
  WorstLoad segments;  ///< of loads under which every segment has another tension and stiffness
};

/// The reduced model that is learned once for a heart and its tissue: a space nested in the full-order model
/// and few of its integration points, with new weights.
struct TunedModel {
  NestedSpace space;
  polyaffine::WallPoints wall;
  std::vector<CavitySurface> cavities;
  polyaffine::SurfacePoints epicardium;
  polyaffine::Matrix pressure_mass;
  ErrorCheck check;
  std::vector<TuningRound> rounds;  ///< up to that of the model, the best there was
  bool reached = false;             ///< the accuracy that was asked for
};

/// Full-order solves that a model was learned from; 0 without one.
int full_order_solves(const TunedModel* model);

/// How long it was learned; 0 without one.
double learning_seconds(const TunedModel* model);

/// How many times the accuracy a model may be off where every segment has another tension and stiffness.
inline constexpr double kSegmentsAllowance = 3;

/// How a tuning is bounded and watched.
struct TuningControl {
  /// Of displacement (L2 over the wall) in loads held out; where every segment has changed, three times it.
  double accuracy_percent = 1;
  double budget_s = 900;  ///< no round begins later
  std::function<void(const std::string& what, double fraction)> progress{};
  std::function<void(const TuningRound&)> on_round{};
  std::function<bool()> interrupted{};  ///< asked between full-order solves; true ends the tuning
};

/// Solves the full-order states of the plan, each continued from a neighbour, finds modes and points, holds
/// the model against loads that it has not seen, learns from these too and goes on with finer tolerances
/// until the accuracy is reached or the budget is spent. Throws ComputationError when the first load has no
/// equilibrium or it was interrupted.
TunedModel tune(const std::shared_ptr<const Anatomy>& anatomy, const Scene& scene, const TuningPlan& plan,
                const TuningControl& control);

/// The functions, points and surfaces of a tuned model, and of the larger one that checks it.
Discretisation tuned_discretisation(const Anatomy& anatomy, const Scene& scene, const TunedModel& model);
Discretisation check_discretisation(const Anatomy& anatomy, const Scene& scene, const TunedModel& model);

}  // namespace cardiac
