#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <cardiac/circulation/two_sided_loop.hpp>
#include <cardiac/heart/beat_result.hpp>
#include <cardiac/heart/ventricle.hpp>
#include <polyaffine/solve/dae.hpp>

namespace cardiac {

/// One state of the coupled heart; coefficients of the wall, mm³, kPa, ms from the start of the beat.
struct HeartState {
  double time_ms = 0;
  polyaffine::Vector c;
  double volume_mm3 = 0, pressure_kPa = 0, capacitor_pressure_kPa = 0;  ///< of the left ventricle
  double right_volume_mm3 = 0, right_pressure_kPa = 0;
  /// Pressures of the closed loop of two ventricles, kPa: pulmonary arteries, pulmonary veins, systemic veins
  /// (those of the systemic arteries are capacitor_pressure_kPa); empty with one ventricle.
  polyaffine::Vector loop{};
};

/// The path of a run: states of its last beat (or of a loading), and what it took to compute.
struct HeartPath {
  std::vector<HeartState> steps;           ///< every accepted step of the last beat, begin and end included
  std::vector<HeartState> outputs;         ///< at multiples of the output interval
  std::vector<double> stroke_volumes_mm3;  ///< one a beat
  int beats = 0, time_steps = 0, newton_iterations = 0;
  int cuts = 0;  ///< load steps that failed and were halved
  SolveCost cost;
  double simulated_ms = 0;
  double beat_start_ms = 0;  ///< of the last beat, on the clock of the contraction
  double min_det_F = 1, max_det_F = 1;
  bool completed = false;
  std::string stop_reason;
  std::vector<std::string> warnings;
  BuildCount built;  ///< parts of the run beside the ventricle's
};

/// Called now and then with the time simulated and, of what is to be done at most, the fraction done.
using Progress = std::function<void(const std::string& what, double fraction)>;

struct Checkpoint;

/// How a run is watched, stopped and taken up again; every part may be absent.
struct RunControl {
  Progress progress{};
  std::function<std::string()> stop_reason{};  ///< asked after each step; not empty: ends the run
  std::function<void(const Checkpoint& at)> on_checkpoint{};  ///< called before each beat
  std::shared_ptr<const Checkpoint> resume{};                 ///< where to go on instead of filling the wall
};

LeftHeartLoop left_heart_loop(const protocol::Circulation& circulation);
TwoSidedLoop two_sided_loop(const protocol::Circulation& circulation);

/// Beats of one or two ventricles coupled to their circulation, from the wall filled to the filling pressures
/// until two strokes differ by less than the limit-cycle tolerance or max_beats is reached. Unknowns: the
/// coefficients c, the cavity volume V and pressure p and the capacitor pressure p_c, in the index-1 system
///   ∂W/∂c(c, ċ, τ(t)) − p ∂V/∂c = 0,  V − V(c) = 0,  V̇ = q_mitral − q_aortic,  C ṗ_c = q_aortic − (p_c −
///   p_ref)/R,
/// or, with two ventricles, with both volumes and pressures and the closed loop (TwoSidedCirculation) instead
/// of the last two equations; integrated by IDA, begun anew at each beat, with the block elimination of all
/// unknowns but c. A run that cannot go on returns what it has with completed = false and the reason. Throws
/// InputError for a checkpoint of another number of unknowns.
HeartPath run_beats(const Ventricle& ventricle, const Protocol& protocol, const RunControl& control = {});

/// A ventricle without circulation: pressure raised to the prescribed value in equilibrium and, with
/// contraction, then held while the tension follows its course over duration_ms. Time of the loading runs
/// from 0 to duration_ms too.
HeartPath run_prescribed(const Ventricle& ventricle, const Protocol& protocol,
                         const RunControl& control = {});

}  // namespace cardiac
