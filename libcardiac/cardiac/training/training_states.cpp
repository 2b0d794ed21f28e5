#include "cardiac/training/training_states.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <polyaffine/core/error.hpp>

namespace cardiac {

TrainingStates::TrainingStates(FullOrder& full, const std::vector<TrainingLoad>& loads,
                               std::function<void(const std::string&)> tell)
    : full_(full), loads_(loads), tell_(std::move(tell)), plain_(full.ventricle({})) {
  for (const TrainingLoad& load : loads_) {
    if (load.pressures_kPa.size() > 0)
      largest_pressure_ = std::max(largest_pressure_, load.pressures_kPa.cwiseAbs().maxCoeff());
    largest_tension_ = std::max(largest_tension_, mean_tension(load));
  }
}

double TrainingStates::mean_tension(const TrainingLoad& load) const {
  return plain_.contraction ? load.level * plain_.contraction->tension(load.clock_ms).mean() : 0;
}

double TrainingStates::distance(const TrainingLoad& a, const TrainingLoad& b) const {
  double sum = std::abs(mean_tension(a) - mean_tension(b)) / largest_tension_;
  for (Eigen::Index k = 0; k < a.pressures_kPa.size(); ++k)
    sum += std::abs(a.pressures_kPa[k] - b.pressures_kPa[k]) / largest_pressure_;
  return sum;
}

const FullState* TrainingStates::nearest(const TrainingLoad& load) const {
  const auto state =
      std::ranges::min_element(path_, {}, [&](const FullState& s) { return distance(s.load, load); });
  return state == path_.end() ? nullptr : &*state;
}

void TrainingStates::solve_path() {
  for (const TrainingLoad& load : loads_) {
    tell_("full order: " + load.name);
    auto state = path_.empty() ? full_.solve(load, nullptr) : full_.follow(load, *nearest(load));
    if (state)
      path_.push_back(std::move(*state));
    else if (path_.empty())
      throw polyaffine::ComputationError(
          "tuning: the full-order model has no equilibrium under its first load, " + load.name);
  }
}

void TrainingStates::add(FullState state) {
  (state.load.regions.empty() ? path_ : neighbours_).push_back(std::move(state));
}

void TrainingStates::add_answers(const FullState& of, const std::vector<scene::RegionOverride>& changes) {
  tell_("answers of " + of.load.name + " to changes of the segments");
  for (FullState& answer : full_.linear_answers(of, changes)) neighbours_.push_back(std::move(answer));
}

void TrainingStates::add_full_answers(const FullState& of,
                                      const std::vector<scene::RegionOverride>& changes) {
  tell_("equilibria of " + of.load.name + " with changed segments");
  for (FullState& answer : full_.answers(of, changes)) neighbours_.push_back(std::move(answer));
}

const FullState* TrainingStates::named(const std::string& load) const {
  const auto state = std::ranges::find(path_, load, [](const FullState& s) { return s.load.name; });
  return state == path_.end() ? nullptr : &*state;
}

std::vector<const FullState*> TrainingStates::all() const {
  std::vector<const FullState*> out;
  for (const auto* list : {&path_, &neighbours_})
    for (const FullState& state : *list) out.push_back(&state);
  return out;
}

}  // namespace cardiac
