#include "cardiac/training/tuned_model.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include <polyaffine/core/error.hpp>
#include <polyaffine/solve/load_stepping.hpp>

namespace cardiac {

using polyaffine::Matrix;
using polyaffine::Vector;

namespace {

// Shares of the accuracy (of displacement in L2, where a tolerance is of its gradient).
constexpr double kPathShare = 0.3, kNeighbourShare = 0.8, kRuleShare = 0.4;
// Pressures want to be fewer than displacements: with modes alone more of them hold the wall back.
constexpr double kPressureShare = 6, kPressureShareOfFrames = 2;
// With looser ones (3 pressures to 40 modes) a wall changes its volume from place to place: on a coarse mesh
// 9 % off where the nearest function is 1.4.
constexpr double kLoosePressure = 0.06;
constexpr int kMostModes = 150;
// A rule that is asked for less keeps so few points that what it misses is no longer small.
constexpr double kLooseRule = 0.004;
constexpr double kRefinement = 0.6;  // of the tolerances, from round to round
// An error in a state of the path counts so many times as one in an answer to other segments.
constexpr double kPathMatters = 2;
// The functions of a model limit it where the nearest of them is off by this share of its error.
constexpr double kLimited = 0.3;
// The functions of its error check: tolerances over those of the model, and how many more there may be.
constexpr double kFiner = 0.25, kMore = 1.6;

// A load held out: the truth, what the model made of it (none where it failed), the nearest of its functions.
struct Comparison {
  FullState truth;
  std::optional<NestedState> model;
  double displacement = 1, volume = 1, best = 1;  // relative errors
};

void note_worst(const Comparison& of, WorstLoad& worst) {
  worst.volume_percent = std::max(worst.volume_percent, 100 * of.volume);
  if (!worst.load.empty() && 100 * of.displacement <= worst.displacement_percent) return;
  worst.displacement_percent = 100 * of.displacement;
  worst.best_percent = 100 * of.best;
  worst.load = of.truth.load.name;
}

struct Tolerances {
  double path, neighbours, pressures, rule;
};

class Tuning {
 public:
  Tuning(const std::shared_ptr<const Anatomy>& anatomy, const Scene& scene, const TuningPlan& plan,
         const TuningControl& control)
      : plan_(plan),
        control_(control),
        full_(anatomy, scene),
        modes_(*anatomy, scene),
        plain_(full_.ventricle({})),
        states_(full_, plan.path, [this](const std::string& what) { tell(what); }) {}

  TunedModel run() {
    states_.solve_path();
    for (const TuningPlan::Changes& changes : plan_.neighbours)
      if (const FullState* state = states_.named(changes.of)) states_.add_answers(*state, changes.regions);
    for (const TuningPlan::Changes& changes : plan_.far_neighbours)
      if (const FullState* state = states_.named(changes.of))
        states_.add_full_answers(*state, changes.regions);
    const double accuracy = control_.accuracy_percent / 100;
    const double pressure = full_.scene().reduction.affine_frames ? kPressureShareOfFrames : kPressureShare;
    Tolerances tolerances{kPathShare * accuracy, kNeighbourShare * accuracy,
                          std::min(pressure * accuracy, kLoosePressure),
                          std::min(kRuleShare * accuracy, kLooseRule)};
    TunedModel model, best;
    double least = 0;
    for (int round = 0;; ++round) {
      build(tolerances, round, model);
      const std::vector<Comparison> found = hold_against(plan_.held_out(round), model, round);
      const TuningRound& last = model.rounds.back();
      if (control_.on_round) control_.on_round(last);
      const double off = std::max(last.protocol.displacement_percent,
                                  last.segments.displacement_percent / kSegmentsAllowance) /
                         control_.accuracy_percent;
      model.reached = off <= 1;
      if (round == 0 || off < least) {
        least = off;
        teach_check(tolerances, found, model);
        best = model;
      }
      if (model.reached || last.seconds * (round + 2) / (round + 1) > control_.budget_s) return best;
      learn(found);
      refine(last, tolerances);
    }
  }

 private:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }
  void tell(const std::string& what) const {
    if (control_.interrupted && control_.interrupted())
      throw polyaffine::ComputationError("tuning: interrupted while " + what);
    if (control_.progress) control_.progress(what, std::min(1.0, seconds() / control_.budget_s));
  }

  void build(const Tolerances& tolerances, int round, TunedModel& model) {
    const HeartModes::States all = states_.all();
    const HeartModes::States path(all.begin(), all.begin() + std::ssize(states_.path()));
    model.space = modes_.with_modes(modes_.affine(), path, tolerances.path, kMostModes);
    model.space = modes_.with_modes(std::move(model.space), all, tolerances.neighbours, kMostModes);
    model.space = modes_.with_pressures(std::move(model.space), all, tolerances.pressures, kMostModes);
    tell("points for " + std::to_string(model.space.num_modes) + " modes");
    NestedRuleTraining training(full_, modes_, model.space);
    for (std::size_t k = 0; k < all.size(); ++k) {
      tell("round " + std::to_string(round + 1) + ": forces of " + all[k]->load.name);
      training.add(*all[k], k < path.size() ? kPathMatters : 1);
    }
    tell("round " + std::to_string(round + 1) + ": choice of points");
    const Discretisation kept = with_rule(training.nested(), training.select(tolerances.rule));
    model.wall = kept.points;
    model.cavities = kept.cavities;
    model.epicardium = kept.epicardium_points;
    model.pressure_mass = kept.pressure_mass;
    metric_ = training.metric();
  }

  std::vector<Comparison> hold_against(const std::vector<TrainingLoad>& loads, TunedModel& model, int round) {
    const Discretisation d = tuned_discretisation(*full_.anatomy(), full_.scene(), model);
    TuningRound out;
    out.modes = model.space.num_modes;
    out.pressures = static_cast<int>(model.space.pressures.rows());
    out.unknowns = d.num_unknowns;
    out.points = static_cast<int>(d.points.tet.size());
    std::vector<Comparison> all;
    for (const TrainingLoad& load : loads) {
      tell("round " + std::to_string(round + 1) + ": held against " + load.name);
      auto found = compare(load, model, d);
      if (!found) continue;
      note_worst(*found, load.regions.empty() ? out.protocol : out.segments);
      all.push_back(std::move(*found));
    }
    if (all.empty())
      throw polyaffine::ComputationError(
          "tuning: the full-order model has no equilibrium under any of the loads held out");
    out.full_order_solves = full_.solves();
    out.seconds = seconds();
    model.rounds.push_back(out);
    return all;
  }

  // The model against full order under a load. None where full order fails.
  std::optional<Comparison> compare(const TrainingLoad& load, const TunedModel& model,
                                    const Discretisation& d) {
    const Ventricle v = assemble_ventricle(full_.anatomy(), with_regions(full_.scene(), load), d);
    const polyaffine::System system = loaded_ventricle(v, wall_load(v, load));
    Vector c = Vector::Zero(v.num_coefficients());
    Comparison out;
    std::optional<FullState> near;
    if (polyaffine::load_stepping(system, *system.make_linear(), c, {}).converged()) {
      out.model = {load, c, {}};
      near = {load, modes_.nodal(model.space, c), {}};
      if (v.wall->pressure_space()) {
        out.model->pressure = v.wall->pressure(c);
        near->pressure = model.space.pressures.transpose() * out.model->pressure;
      }
    }
    auto truth = full_.solve(load, near ? &*near : states_.nearest(load));
    if (!truth) return std::nullopt;
    out.truth = std::move(*truth);
    const Vector& u = out.truth.u;
    const double size = modes_.size(u);
    out.best = modes_.size(modes_.nodal(model.space, modes_.nearest(model.space, metric_, u)) - u) / size;
    if (!out.model) return out;
    out.displacement = modes_.size(near->u - u) / size;
    const Vector volumes = plain_.cavity_volumes(u);
    out.volume =
        volumes.size() > 0 ? (v.cavity_volumes(c).cwiseQuotient(volumes).array() - 1).abs().maxCoeff() : 0;
    return out;
  }

  // The functions and the factor of the model's error check. What was held out has not been learned yet.
  void teach_check(const Tolerances& tolerances, const std::vector<Comparison>& held_out, TunedModel& model) {
    tell("error check");
    ErrorCheck& check = model.check;
    check = {};
    const int most = static_cast<int>(kMore * model.space.num_modes);
    check.space = modes_.with_modes(model.space, states_.all(), kFiner * tolerances.neighbours, most);
    check.space =
        modes_.with_pressures(std::move(check.space), states_.all(), kFiner * tolerances.pressures,
                              static_cast<int>(kMore * static_cast<double>(model.space.pressures.rows())));
    check.pressure_mass =
        nested_discretisation(*full_.anatomy(), full_.scene(), check.space, full_.discretisation())
            .pressure_mass;
    const Discretisation larger = check_discretisation(*full_.anatomy(), full_.scene(), model);
    double sum = 0;
    int count = 0;
    for (const Comparison& c : held_out) {
      // Errors under the loads of the protocol are small, and estimated too large rather than too small.
      if (!c.model || c.model->load.regions.empty()) continue;
      const auto estimate = estimated_error(
          check, assemble_ventricle(full_.anatomy(), with_regions(full_.scene(), c.model->load), larger),
          full_.ventricle(c.model->load), *c.model);
      if (!estimate || !(*estimate > 0 && c.displacement > 0)) continue;
      sum += std::log(c.displacement / *estimate);
      ++count;
    }
    if (count > 0) check.factor = std::exp(sum / count);
  }

  // What was held out is learned; where the functions were too poor, also how it answers to other segments.
  void learn(const std::vector<Comparison>& held_out) {
    for (const Comparison& c : held_out) {
      const bool other_segments = !c.truth.load.regions.empty();
      if (other_segments && 100 * c.displacement > kSegmentsAllowance * control_.accuracy_percent &&
          c.best > kLimited * c.displacement)
        for (const TuningPlan::Changes& changes : plan_.neighbours)
          if (c.truth.load.name.starts_with(changes.of)) states_.add_answers(c.truth, changes.regions);
      states_.add(c.truth);
    }
  }

  void refine(const TuningRound& round, Tolerances& tolerances) const {
    const auto refine_for = [&](const WorstLoad& worst, double allowed, double& of_space) {
      if (worst.displacement_percent <= allowed) return;
      if (worst.best_percent > kLimited * worst.displacement_percent) of_space *= kRefinement;
      tolerances.pressures *= kRefinement;
      tolerances.rule *= kRefinement;
    };
    const double accuracy = control_.accuracy_percent;
    refine_for(round.protocol, accuracy, tolerances.path);
    refine_for(round.segments, kSegmentsAllowance * accuracy, tolerances.neighbours);
  }

  const TuningPlan& plan_;
  const TuningControl& control_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  FullOrder full_;
  HeartModes modes_;
  Ventricle plain_;
  TrainingStates states_;
  Matrix metric_;
};

}  // namespace

TunedModel tune(const std::shared_ptr<const Anatomy>& anatomy, const Scene& scene, const TuningPlan& plan,
                const TuningControl& control) {
  return Tuning(anatomy, scene, plan, control).run();
}

int full_order_solves(const TunedModel* model) {
  return model ? model->rounds.back().full_order_solves : 0;
}

double learning_seconds(const TunedModel* model) {
  return model ? model->rounds.back().seconds : 0;
}

namespace {

Discretisation with_points_of(const TunedModel& model, const NestedSpace& space, const Matrix& pressure_mass,
                              const Anatomy& anatomy, const Scene& scene) {
  Discretisation points;
  points.points = model.wall;
  points.cavities = model.cavities;
  points.epicardium_points = model.epicardium;
  Discretisation out = nested_discretisation(anatomy, scene, space, points);
  out.pressure_mass = pressure_mass;
  return out;
}

}  // namespace

Discretisation tuned_discretisation(const Anatomy& anatomy, const Scene& scene, const TunedModel& model) {
  return with_points_of(model, model.space, model.pressure_mass, anatomy, scene);
}

Discretisation check_discretisation(const Anatomy& anatomy, const Scene& scene, const TunedModel& model) {
  return with_points_of(model, model.check.space, model.check.pressure_mass, anatomy, scene);
}

}  // namespace cardiac
