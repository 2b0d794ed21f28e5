#pragma once

#include <cardiac/heart/beat.hpp>

namespace cardiac {

/// The coupled ventricle and circulation as a DAE over y = [c, V, p, p_c]; see run_beats.
class BeatSystem : public polyaffine::DaeSystem {
 public:
  BeatSystem(const Ventricle& ventricle, const LeftHeartLoop& loop);

  int size() const override { return num_c_ + 3; }
  bool residual(double t, const polyaffine::Vector& y, const polyaffine::Vector& rate,
                polyaffine::Vector& out) override;
  bool factorise(double t, const polyaffine::Vector& y, const polyaffine::Vector& rate,
                 double alpha) override;
  bool solve(const polyaffine::Vector& rhs, polyaffine::Vector& x) override;

  polyaffine::Vector pack(const HeartState& state) const;
  HeartState unpack(double t, double beat_start_ms, const polyaffine::Vector& y) const;
  /// Moves the pressure of a wall in static equilibrium by the viscous pressure δ of the flow that its valves
  /// let through, and returns the rates, so that the residual vanishes at the start: with z = C⁻¹ ∂V/∂c and C
  /// the viscous tangent, ċ = δ z and V̇ = δ zᵀ∂V/∂c = q_mitral − q_aortic at p + δ, solved by Newton's
  /// method. Without viscosity δ = 0 and ċ is the elastic motion at the rate V̇. On failure (a singular
  /// tangent) the wall keeps its rest.
  polyaffine::Vector start_consistently(HeartState& state);
  /// Tolerances per unknown. The error norm is a mean over all unknowns: volume and pressures are weighted so
  /// that they count as much as the whole wall, however many coefficients it has.
  polyaffine::DaeOptions options(const protocol::Time& time) const;

  /// Range of det F over the points in the state evaluated last; after a step that is the accepted one, but
  /// for the last Newton correction.
  double min_det() const { return min_det_; }
  double max_det() const { return max_det_; }
  /// Calls so far and their time.
  const SolveCost& cost() const { return cost_; }
  SolveCost& cost() { return cost_; }

 private:
  const polyaffine::Vector& tension(double t);

  const Ventricle& ventricle_;
  LeftHeartLoop loop_;
  int num_c_;
  std::unique_ptr<polyaffine::LinearSystem> system_;
  double tension_time_;
  polyaffine::Vector tension_;
  polyaffine::Vector volume_gradient_, solved_gradient_;  // g and K⁻¹g of the last factorisation
  LoopResidual loop_state_{};  // at the state evaluated last: valves open and close within a step
  double alpha_ = 0;
  double min_det_ = 1, max_det_ = 1;
  SolveCost cost_;
};

}  // namespace cardiac
