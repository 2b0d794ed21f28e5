#pragma once

#include <cardiac/circulation/circulation_model.hpp>
#include <cardiac/core/beat_result.hpp>
#include <cardiac/core/heart_state.hpp>
#include <cardiac/model/ventricle.hpp>
#include <polyaffine/solve/dae.hpp>

namespace cardiac {

/// The coupled ventricles and circulation as a DAE over y = [c, V, p, z], with a volume and a pressure for
/// each cavity and the other states z of the circulation (with one ventricle p_c); see run_beats.
class BeatSystem : public polyaffine::DaeSystem {
 public:
  BeatSystem(const Ventricle& ventricle, std::shared_ptr<const CirculationModel> circulation);
  BeatSystem(const Ventricle& ventricle, const LeftHeartLoop& loop)
      : BeatSystem(ventricle, std::make_shared<LeftHeartCirculation>(loop)) {}

  int size() const override { return num_c_ + num_states_ + num_cavities_; }
  bool residual(double t, const polyaffine::Vector& y, const polyaffine::Vector& rate,
                polyaffine::Vector& out) override;
  bool factorise(double t, const polyaffine::Vector& y, const polyaffine::Vector& rate,
                 double alpha) override;
  /// Newton's correction x for the right side −R of the residual evaluated last: the wall linearised as
  /// factorised, the circulation met as it is (its own equations solved to 1e-10), since stiff valves bend
  /// sharply.
  bool solve(const polyaffine::Vector& rhs, polyaffine::Vector& x) override;

  polyaffine::Vector pack(const HeartState& state) const;
  HeartState unpack(double t, double beat_start_ms, const polyaffine::Vector& y) const;
  /// Moves the pressures of a wall in static equilibrium by the viscous pressures δ of the flows that its
  /// valves let through, and returns the rates, so that the residual vanishes at the start: with Z = C⁻¹
  /// ∂V/∂c and C the viscous tangent, ċ = Z δ and V̇ = (∂V/∂c)ᵀZ δ, the flows of the circulation at p + δ,
  /// solved by Newton's method. Without viscosity δ = 0 and ċ is the elastic motion at the rate V̇. On failure
  /// (a singular tangent) the wall keeps its rest.
  polyaffine::Vector start_consistently(HeartState& state);
  /// The same from a wall in motion: moves the cavity pressures of y, with its rate, to where the flows of
  /// circulation states that were changed just now meet the motion, and changes the rate.
  void restart_consistently(double t, polyaffine::Vector& y, polyaffine::Vector& rate);
  /// Tolerances per unknown. The error norm is a mean over all unknowns: volume and pressures are weighted so
  /// that they count as much as the whole wall, however many coefficients it has. Newton's iterations meet
  /// the pressures of the cavities to their tolerance; the error test leaves them out.
  polyaffine::DaeOptions options(const protocol::Time& time) const;

  const CirculationModel& circulation() const { return *circulation_; }
  int num_cavities() const { return num_cavities_; }
  polyaffine::Vector states(const polyaffine::Vector& y) const;      ///< of the circulation: V, then z
  polyaffine::Vector pressures(const polyaffine::Vector& y) const {  ///< of the cavities
    return y.segment(num_c_ + num_cavities_, num_cavities_);
  }
  /// The vessels' pressures z, kPa, to be changed.
  Eigen::VectorBlock<polyaffine::Vector> vessels(polyaffine::Vector& y) const {
    return y.tail(num_states_ - num_cavities_);
  }

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
  std::shared_ptr<const CirculationModel> circulation_;
  std::vector<const polyaffine::FieldEnergy*> cavities_;
  int num_c_, num_cavities_, num_states_;
  std::unique_ptr<polyaffine::LinearSystem> system_;
  double tension_time_;
  polyaffine::Vector tension_;
  polyaffine::Matrix volume_gradient_, solved_gradient_;  // g and K⁻¹g of the last factorisation, by cavity
  CirculationModel::Rates circulating_;  // at the state evaluated last: valves open and close within a step
  polyaffine::Vector circulating_states_, circulating_pressures_;  // that state
  double alpha_ = 0;
  double min_det_ = 1, max_det_ = 1;
  SolveCost cost_;
};

}  // namespace cardiac
