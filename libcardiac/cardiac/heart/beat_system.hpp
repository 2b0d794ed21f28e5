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
  /// Rates consistent with the circulation, the wall at rest.
  polyaffine::Vector initial_rate(const HeartState& state) const;
  /// Tolerances per unknown. The error norm is a mean over all unknowns: volume and pressures are weighted so
  /// that they count as much as the whole wall, however many coefficients it has.
  polyaffine::DaeOptions options(const protocol::Time& time) const;

  /// Range of det F over the points in the state evaluated last; after a step that is the accepted one, but
  /// for the last Newton correction.
  double min_det() const { return min_det_; }
  double max_det() const { return max_det_; }

 private:
  const polyaffine::Vector& tension(double t);

  const Ventricle& ventricle_;
  LeftHeartLoop loop_;
  int num_c_;
  std::unique_ptr<polyaffine::LinearSystem> system_;
  double tension_time_;
  polyaffine::Vector tension_;
  polyaffine::Vector volume_gradient_, solved_gradient_;  // g and K⁻¹g of the last factorisation
  LoopResidual loop_slopes_{};
  double alpha_ = 0;
  double min_det_ = 1, max_det_ = 1;
};

}  // namespace cardiac
