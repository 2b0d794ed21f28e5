#include "cardiac/training/tuned_model.hpp"

#include <Eigen/SVD>
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
constexpr int kMostModes = 75;
// A rule that is asked for less keeps so few points that what it misses is no longer small.
constexpr double kLooseRule = 0.004;
constexpr double kRefinement = 0.6;  // of the tolerances, from round to round

// How different two loads are, in pressure and tension over the largest of the plan.
class LoadDistance {
 public:
  LoadDistance(const std::vector<TrainingLoad>& loads, const Ventricle& ventricle) : ventricle_(ventricle) {
    for (const TrainingLoad& load : loads) {
      if (load.pressures_kPa.size() > 0)
        pressure_ = std::max(pressure_, load.pressures_kPa.cwiseAbs().maxCoeff());
      tension_ = std::max(tension_, mean_tension(load));
    }
  }
  double operator()(const TrainingLoad& a, const TrainingLoad& b) const {
    double sum = std::abs(mean_tension(a) - mean_tension(b)) / tension_;
    for (Eigen::Index k = 0; k < a.pressures_kPa.size(); ++k)
      sum += std::abs(a.pressures_kPa[k] - b.pressures_kPa[k]) / pressure_;
    return sum + (a.regions.empty() == b.regions.empty() ? 0 : 1);
  }

 private:
  double mean_tension(const TrainingLoad& load) const {
    return ventricle_.contraction ? load.level * ventricle_.contraction->tension(load.clock_ms).mean() : 0;
  }
  const Ventricle& ventricle_;
  double pressure_ = 1e-9, tension_ = 1e-9;
};

struct Comparison {
  double displacement = 0, volume = 0, best = 0;  // relative
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
        distance_(plan.path, plain_) {}

  TunedModel run() {
    solve_path();
    add_linear_answers();
    const double accuracy = control_.accuracy_percent / 100;
    const double pressure = full_.scene().reduction.affine_frames ? kPressureShareOfFrames : kPressureShare;
    HeartModes::Options options{kPathShare * accuracy, kNeighbourShare * accuracy, pressure * accuracy,
                                kMostModes};
    double rule = std::min(kRuleShare * accuracy, kLooseRule);
    TunedModel model, best;
    for (int round = 0;; ++round) {
      build(options, rule, round, model);
      const TuningRound found = hold_against(plan_.held_out(round), model, round);
      model.rounds.push_back(found);
      if (control_.on_round) control_.on_round(found);
      model.reached = found.displacement_percent <= control_.accuracy_percent;
      const double a_round = found.seconds / (round + 1);
      if (best.rounds.empty() || found.displacement_percent < best.rounds.back().displacement_percent)
        best = model;
      if (model.reached || found.seconds + a_round > control_.budget_s) return best;
      // More modes help only where the space itself is far from the truth.
      if (found.best_percent > 0.3 * found.displacement_percent) {
        options.tolerance *= kRefinement;
        options.neighbour_tolerance *= kRefinement;
      }
      rule *= kRefinement;
      options.pressure_tolerance *= kRefinement;
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

  const FullState* nearest(const TrainingLoad& load) const {
    const FullState* best = nullptr;
    for (const FullState& s : path_)
      if (!best || distance_(s.load, load) < distance_(best->load, load)) best = &s;
    return best;
  }

  void solve_path() {
    for (const TrainingLoad& load : plan_.path) {
      tell("full order: " + load.name);
      auto state = full_.solve(load, nearest(load));
      if (state)
        path_.push_back(std::move(*state));
      else if (path_.empty())
        throw polyaffine::ComputationError(
            "tuning: the full-order model has no equilibrium under its first load, " + load.name);
    }
  }

  void add_linear_answers() {
    for (const TuningPlan::Changes& changes : plan_.neighbours) {
      const auto state = std::ranges::find(path_, changes.of, [](const FullState& s) { return s.load.name; });
      if (state == path_.end()) continue;
      tell("answers of " + changes.of + " to changes of the segments");
      for (FullState& answer : full_.linear_answers(*state, changes.regions))
        neighbours_.push_back(std::move(answer));
    }
  }

  void build(const HeartModes::Options& options, double rule_accuracy, int round, TunedModel& model) {
    model.space = modes_.space(path_, neighbours_, options);
    tell("points for " + std::to_string(model.space.num_modes) + " modes");
    NestedRuleTraining training(full_, modes_, model.space);
    for (const auto* states : {&path_, &neighbours_})
      for (const FullState& state : *states) {
        tell("round " + std::to_string(round + 1) + ": forces of " + state.load.name);
        training.add(state);
      }
    tell("round " + std::to_string(round + 1) + ": choice of points");
    const NestedRule rule = training.select(rule_accuracy);
    const Discretisation kept = training.with(rule);
    model.wall = kept.points;
    model.cavities = kept.cavities;
    model.epicardium = kept.epicardium_points;
    model.pressure_mass = kept.pressure_mass;
    find_range(training.metric(), model);
    metric_ = training.metric();
  }

  void find_range(const Matrix& metric, TunedModel& model) const {
    const auto count = std::ssize(path_) + std::ssize(neighbours_);
    const Matrix root = metric.llt().matrixU();
    Matrix states(metric.rows(), count);
    Eigen::Index s = 0;
    for (const auto* list : {&path_, &neighbours_})
      for (const FullState& state : *list)
        states.col(s++) = root * modes_.nearest(model.space, metric, state.u);
    const Eigen::BDCSVD<Matrix> svd(states, Eigen::ComputeThinU);
    const Matrix along = svd.matrixU().transpose() * states;
    model.coordinates = svd.matrixU().transpose() * root;
    model.least = along.rowwise().minCoeff().cwiseMin(0);
    model.largest = along.rowwise().maxCoeff().cwiseMax(0);
  }

  TuningRound hold_against(const std::vector<TrainingLoad>& loads, const TunedModel& model, int round) {
    const Discretisation d = tuned_discretisation(*full_.anatomy(), full_.scene(), model);
    TuningRound out;
    out.modes = model.space.num_modes;
    out.pressures = static_cast<int>(model.space.pressures.rows());
    out.unknowns = d.num_unknowns;
    out.points = static_cast<int>(d.points.tet.size());
    for (const TrainingLoad& load : loads) {
      tell("round " + std::to_string(round + 1) + ": held against " + load.name);
      const auto found = compare(load, model, d);
      if (!found) continue;
      out.volume_percent = std::max(out.volume_percent, 100 * found->volume);
      if (!out.worst.empty() && 100 * found->displacement <= out.displacement_percent) continue;
      out.displacement_percent = 100 * found->displacement;
      out.best_percent = 100 * found->best;
      out.worst = load.name;
    }
    if (out.worst.empty())
      throw polyaffine::ComputationError(
          "tuning: the full-order model has no equilibrium under any of the loads held out");
    out.full_order_solves = full_.solves();
    out.seconds = seconds();
    return out;
  }

  // The model against full order under a load, which is then learned from. None where full order fails.
  std::optional<Comparison> compare(const TrainingLoad& load, const TunedModel& model,
                                    const Discretisation& d) {
    const Ventricle v = assemble_ventricle(full_.anatomy(), with_regions(full_.scene(), load), d);
    const polyaffine::System system = loaded_ventricle(v, wall_load(v, load));
    Vector c = Vector::Zero(v.num_coefficients());
    const bool solved = polyaffine::load_stepping(system, *system.make_linear(), c, {}).converged();
    const auto& basis = dynamic_cast<const polyaffine::NestedBasis&>(*d.basis);
    FullState start{load, basis.nodal(c), {}};
    if (v.wall->pressure_space()) start.pressure = model.space.pressures.transpose() * v.wall->pressure(c);
    auto state = full_.solve(load, solved ? &start : nearest(load));
    if (!state) return std::nullopt;
    Comparison out{1, 1, 1};
    const double size = modes_.size(state->u);
    if (solved) out.displacement = modes_.size(start.u - state->u) / size;
    const Vector best = basis.nodal(modes_.nearest(model.space, metric_, state->u));
    out.best = modes_.size(best - state->u) / size;
    if (solved && !v.cavities.empty()) {
      const Vector volumes = plain_.cavity_volumes(state->u);
      out.volume = (v.cavity_volumes(c).cwiseQuotient(volumes).array() - 1).abs().maxCoeff();
    }
    (load.regions.empty() ? path_ : neighbours_).push_back(std::move(*state));
    return out;
  }

  const TuningPlan& plan_;
  const TuningControl& control_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  FullOrder full_;
  HeartModes modes_;
  Ventricle plain_;
  LoadDistance distance_;
  std::vector<FullState> path_, neighbours_;
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

double outside(const TunedModel& model, const Vector& c) {
  constexpr double kMargin = 0.1;
  const Vector at = model.coordinates * c;
  const Vector margin = kMargin * (model.largest - model.least);
  const Vector inside = at.cwiseMax(model.least - margin).cwiseMin(model.largest + margin);
  return at.norm() > 0 ? (at - inside).norm() / at.norm() : 0;
}

Discretisation tuned_discretisation(const Anatomy& anatomy, const Scene& scene, const TunedModel& model) {
  Discretisation points;
  points.points = model.wall;
  points.cavities = model.cavities;
  points.epicardium_points = model.epicardium;
  Discretisation out = nested_discretisation(anatomy, scene, model.space, points);
  out.pressure_mass = model.pressure_mass;
  return out;
}

}  // namespace cardiac
