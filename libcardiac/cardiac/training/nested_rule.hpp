#pragma once

#include <cardiac/training/heart_modes.hpp>
#include <polyaffine/kinematics/nested_basis.hpp>
#include <polyaffine/quadrature/cubature.hpp>

namespace cardiac {

/// The integration points of a nested model that are kept, with their weights.
struct NestedRule {
  KeptPoints wall;
  std::vector<KeptPoints> cavities;
};

/// Some of the points of a nested model, each for the same share of the whole: what a trained rule chooses
/// from.
NestedRule candidate_rule(const Discretisation& nested);
/// The nested model with the points of a rule only.
Discretisation with_rule(const Discretisation& nested, const NestedRule& rule);

/// Trains the sparse rule of a nested model. Of the full-order points some are candidates; few are kept, with
/// weights ≥ 0, so that in given states the generalised forces f and the changes of volume g that pressures
/// see come out as all full-order points have them. With the tangent K of a state (pressures eliminated), D =
/// ∂g/∂c and the metric G of the functions an error (δf, δg) counts as the displacement that it makes,
///   δc = K⁻¹ (δf + κ DᵀM⁻¹ δg),  ‖δc‖_G / ‖c‖_G,
/// and likewise an error of a cavity's force p ∂V/∂c, together with that of its volume, times three.
class NestedRuleTraining {
 public:
  /// All of them must outlive it.
  NestedRuleTraining(FullOrder& full, const HeartModes& modes, const NestedSpace& space);

  /// A state by its full-order displacement and pressures, of which the space holds the nearest; its errors
  /// count `weight` times. False where its tangent is not positive definite: it measures nothing.
  bool add(const FullState& state, double weight = 1);
  /// The points with the wanted root mean square error over the states, that of the cavities a half.
  NestedRule select(double accuracy) const;

  const Discretisation& nested() const { return nested_; }
  const polyaffine::Matrix& metric() const { return metric_; }

 private:
  // What the contributions of a state are measured with.
  struct Measure;
  void add_wall(const Measure& at, const FullState& state);
  void add_cavity(const Measure& at, std::size_t cavity);

  FullOrder& full_;
  const HeartModes& modes_;
  const NestedSpace& space_;
  Discretisation nested_;
  const polyaffine::NestedBasis& basis_;
  NestedRule chosen_from_;
  Discretisation candidates_;
  polyaffine::Matrix metric_, root_;  // G = rootᵀ root
  double states_ = 0;                 // Σ weight²
  polyaffine::CubatureTraining wall_;
  std::vector<polyaffine::CubatureTraining> cavities_;
  std::vector<Cavity> whole_cavities_;  // on all points
};

}  // namespace cardiac
