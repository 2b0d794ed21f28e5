#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <cardiac/model/ventricle.hpp>
#include <polyaffine/solve/newton.hpp>

namespace cardiac {

/// What a wall is asked: pressures of the cavities, the tension of the scene's contraction at a time of its
/// clock times a level, and regions that differ beside those of the scene.
struct TrainingLoad {
  std::string name;
  polyaffine::Vector pressures_kPa{};
  double clock_ms = 0, level = 1;
  std::vector<scene::RegionOverride> regions{};
};

/// The wall under a load: nodal displacement (3 · nodes, mm) and the pressure of each element (kPa; empty
/// without a pressure space).
struct FullState {
  TrainingLoad load;
  polyaffine::Vector u, pressure;
};

/// The scene with the load's regions beside its own.
Scene with_regions(const Scene& scene, const TrainingLoad& load);

/// The load on a ventricle of with_regions, full order or reduced.
WallLoad wall_load(const Ventricle& ventricle, const TrainingLoad& load);

/// The full-order model of a heart, asked for equilibria one after the other; its matrices' pattern is
/// analysed once.
class FullOrder {
 public:
  FullOrder(std::shared_ptr<const Anatomy> anatomy, const Scene& scene);

  /// Of the model of the scene as it is.
  const Discretisation& discretisation() const { return discretisation_; }
  const Scene& scene() const { return scene_; }
  const std::shared_ptr<const Anatomy>& anatomy() const { return anatomy_; }
  /// The model with the load's regions.
  Ventricle ventricle(const TrainingLoad& load) const;

  /// The equilibrium under a load: by Newton's method from a state that is nearly this one, such as a reduced
  /// model's, or, where that fails or there is none, raised from zero. None when that fails too.
  std::optional<FullState> solve(const TrainingLoad& load, const FullState* guess);
  /// The equilibrium under a load without regions, by way of those under the loads between it and that of
  /// another such equilibrium: on this way tangents are positive definite, and they are ten times cheaper
  /// than others. As solve where the way breaks off.
  std::optional<FullState> follow(const TrainingLoad& load, const FullState& from);

  /// How the state answers, to first order, to each of some changes of its regions: for each the state moved
  /// along K⁻¹ ∂f, K the tangent of the state, by as much of the change as moves no point far; the load of
  /// the answer says how much. Empty where K is singular.
  std::vector<FullState> linear_answers(const FullState& state,
                                        const std::vector<scene::RegionOverride>& changes);

  /// The equilibria under the loads of the linear answers, each by Newton's method from it; those that this
  /// does not find are left out.
  std::vector<FullState> answers(const FullState& state, const std::vector<scene::RegionOverride>& changes);

  int solves() const { return solves_; }

  /// Called before each step of Newton's method; may throw.
  std::function<void(int iteration, double residual)> watch{};

 private:
  polyaffine::NewtonOptions newton_options() const;
  bool step_to(const polyaffine::System& system, polyaffine::Vector& u);

  std::shared_ptr<const Anatomy> anatomy_;
  Scene scene_;
  Discretisation discretisation_;
  Ventricle plain_;
  std::unique_ptr<polyaffine::LinearSystem> linear_;
  int solves_ = 0;
};

}  // namespace cardiac
