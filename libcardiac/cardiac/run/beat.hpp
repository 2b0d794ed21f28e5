#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <cardiac/circulation/two_sided_loop.hpp>
#include <cardiac/core/beat_result.hpp>
#include <cardiac/core/heart_state.hpp>
#include <cardiac/model/ventricle.hpp>
#include <cardiac/run/limit_cycle.hpp>
#include <polyaffine/solve/dae.hpp>

namespace cardiac {

/// Instants of one cavity in a beat, found between the time steps; none where there is none. Where a valve
/// closes more than once, the closing with the largest (inlet) or smallest (outlet) volume.
struct CavityInstants {
  std::optional<HeartState> inlet_closes, outlet_closes;  ///< the pressure drop over the valve turns
  std::optional<HeartState> largest, smallest;            ///< the volume turns
};

/// The circulation (states and cavity pressures as of CirculationModel) at a time of the beat.
struct CirculationSample {
  double time_ms = 0;
  polyaffine::Vector states, pressures_kPa;
};

/// The path of a run: states of its last beat (or of a loading), and what it took to compute.
struct HeartPath {
  std::vector<HeartState> steps;         ///< every accepted step of the last beat, begin and end included
  std::vector<HeartState> outputs;       ///< at multiples of the output interval
  std::vector<CavityInstants> instants;  ///< of each cavity in the last beat; empty without circulation
  std::optional<HeartState> contraction_begins;  ///< when the first muscle begins to contract
  std::optional<HeartState> contraction_ends;    ///< and to relax; without circulation only
  std::vector<CirculationSample> circulation;    ///< the last beat, four times a time step
  std::vector<double> stroke_volumes_mm3;        ///< one a beat
  std::vector<CycleBeat> cycle;                  ///< one a beat: what it made of the circulation
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
struct TuningRound;

/// How a run is watched, stopped and taken up again; every part may be absent.
struct RunControl {
  Progress progress{};
  std::function<std::string()> stop_reason{};  ///< asked after each step; not empty: ends the run
  std::function<void(const Checkpoint& at)> on_checkpoint{};  ///< called before each beat
  std::shared_ptr<const Checkpoint> resume{};                 ///< where to go on instead of filling the wall
  std::function<void()> on_built{};     ///< called by simulate when the model stands, before it is solved
  std::function<void()> on_solved{};    ///< and when it is solved, before the path is told in strains
  std::function<void()> on_distrust{};  ///< called by simulate before it begins anew with all points
  std::function<void(const TuningRound&)> on_round{};  ///< called after each round of a tuning
  bool keep_absurd = false;  ///< an absurd result counts as completed, with a warning
};

/// Beats of one or two ventricles coupled to their circulation, from the wall filled to the filling pressures
/// until the last is within the limit-cycle tolerance of the one that would repeat itself
/// (estimate_limit_cycle), noise keeps it from there, or max_beats is reached. From the second beat on each
/// begins with the vessels' pressures of the estimate; in a closed loop without a change of the blood volume.
/// Unknowns: the coefficients c, the cavity volume V and pressure p and the capacitor pressure p_c, in the
/// index-1 system
///   ∂W/∂c(c, ċ, τ(t)) − p ∂V/∂c = 0,  V − V(c) = 0,  V̇ = q_mitral − q_aortic,  C ṗ_c = q_aortic − (p_c −
///   p_ref)/R,
/// or, with two ventricles, with both volumes and pressures and the closed loop (TwoSidedCirculation) instead
/// of the last two equations; integrated by IDA, begun anew at each beat, with the block elimination of all
/// unknowns but c. A run that cannot go on returns what it has with completed = false and the reason. Throws
/// InputError for a checkpoint of another number of unknowns.
HeartPath run_beats(const Ventricle& ventricle, const Scene& scene, const RunControl& control = {});

/// A ventricle without circulation: pressure raised to the prescribed value in equilibrium, in load_steps,
/// the time of the loading running from 0 to duration_ms. With contraction, or where the pressures are
/// curves, the loading takes no time; the wall then follows for duration_ms, the pressures held or along
/// their curves, integrated by IDA with the viscosity of the tissue (pressed_system) and told every
/// interval_ms. Where the volumes are given, the wall is brought to the first ones in equilibrium and follows
/// their curves (GivenVolumes); the pressures are unknowns.
HeartPath run_prescribed(const Ventricle& ventricle, const Scene& scene, const RunControl& control = {});

}  // namespace cardiac
