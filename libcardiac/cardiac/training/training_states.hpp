#pragma once

#include <functional>
#include <string>
#include <vector>

#include <cardiac/training/full_order.hpp>

namespace cardiac {

/// The full-order states that a model of a heart is learned from: those of the path that its protocol asks,
/// each continued from the nearest one before it, and neighbours in which segments differ.
class TrainingStates {
 public:
  /// `full` must outlive it. `tell` is called before each solution with what it is; it may throw.
  TrainingStates(FullOrder& full, const std::vector<TrainingLoad>& loads,
                 std::function<void(const std::string&)> tell);

  /// Solves the loads, those without an equilibrium left out. Throws ComputationError when the first has
  /// none.
  void solve_path();
  /// A state that was solved elsewhere, to the path or, if its load has regions, to the neighbours.
  void add(FullState state);
  /// How a state answers to first order to changes of its segments (FullOrder::linear_answers).
  void add_answers(const FullState& of, const std::vector<scene::RegionOverride>& changes);

  /// How it answers in full (FullOrder::answers).
  void add_full_answers(const FullState& of, const std::vector<scene::RegionOverride>& changes);

  const std::vector<FullState>& path() const { return path_; }
  const std::vector<FullState>& neighbours() const { return neighbours_; }
  /// The state of the path under the load of this name; null if there is none.
  const FullState* named(const std::string& load) const;
  /// The path, then the neighbours.
  std::vector<const FullState*> all() const;
  /// The state of the path under the most similar load, in pressure and tension over the largest of the
  /// loads; null without any.
  const FullState* nearest(const TrainingLoad& load) const;

 private:
  double mean_tension(const TrainingLoad& load) const;
  double distance(const TrainingLoad& a, const TrainingLoad& b) const;

  FullOrder& full_;
  std::vector<TrainingLoad> loads_;
  std::function<void(const std::string&)> tell_;
  Ventricle plain_;
  double largest_pressure_ = 1e-9, largest_tension_ = 1e-9;
  std::vector<FullState> path_, neighbours_;
};

}  // namespace cardiac
