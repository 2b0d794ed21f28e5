#pragma once

#include <optional>
#include <string>
#include <vector>

#include <polyaffine/core/types.hpp>

namespace cardiac {

/// Segment averages in local axes against end diastole: Lagrangian (L−L₀)/L₀ normal strains, Green–Lagrange
/// shears, and volume over end-diastolic volume; dimensionless.
struct SegmentStrain {
  double longitudinal = 0, circumferential = 0, radial = 0;
  double shear_lc = 0, shear_lr = 0, shear_cr = 0;
  double volume_ratio = 1;
};

/// The affine map of a segment since end diastole (see AffineFit), x − q = A (y − q) + t, y and x being the
/// end-diastolic and the present position of its material and q the end-diastolic position of its control
/// node; components in the node's local axes (longitudinal, circumferential, radial). A dimensionless, t in
/// mm.
struct SegmentFrame {
  polyaffine::Mat3 A = polyaffine::Mat3::Identity();
  polyaffine::Vec3 t = polyaffine::Vec3::Zero();
  double misfit = 0;  ///< share of the motion that no affine map holds; NaN without motion
};

/// Mechanics of a segment, means over its volume in the mesh (segment_mechanics). NaN where it does not apply
/// or the segment has no integration point.
struct SegmentMechanics {
  double fibre_strain = 0;       ///< stretch along the fibre since end diastole, minus one
  double fibre_stress_kPa = 0;   ///< Cauchy stress along the fibre, of all that the wall consists of
  double active_stress_kPa = 0;  ///< the part of it that is active
  double mean_stress_kPa = 0;    ///< a third of the trace of the Cauchy stress
  double von_mises_kPa = 0;      ///< of the Cauchy stress
  double work_mJ = 0;            ///< done on its surroundings since the begin of the path
  double active_work_mJ = 0;     ///< done by its active tension
};

/// Energy of a beat: the work of the active tension is what is done on the blood, what the wall, its springs
/// and its motion store, and what viscosity and dashpots lose. Every number is computed on its own.
struct EnergyBalance {
  double active_mJ = 0;                                    ///< work of the active tension
  double cavities_mJ = 0;                                  ///< work on the blood, −Σ ∫ p dV
  double elastic_mJ = 0, supports_mJ = 0, kinetic_mJ = 0;  ///< change of what is stored
  double viscosity_mJ = 0, dashpots_mJ = 0;                ///< lost

  /// What is missing, mJ: active work less all others.
  double residual() const;
  /// |residual| over the larger of |active work| and |work on the blood|; NaN where both are zero.
  double percent() const;
};

/// A control node at end diastole, mm, and its axes (columns longitudinal, circumferential, radial).
struct SegmentNode {
  polyaffine::Vec3 position = polyaffine::Vec3::Zero();
  polyaffine::Mat3 axes = polyaffine::Mat3::Identity();
};

/// Strain along contours at three depths, percent.
struct LayerStrain {
  double endocardial_percent = 0, midwall_percent = 0, epicardial_percent = 0;
};

/// Global strain of a ventricle since end diastole: means over its wall (global_strain), and what is measured
/// along contours (ContourGauge). NaN where it does not apply.
struct GlobalStrain {
  double gls_percent = 0, gcs_percent = 0, grs_percent = 0, twist_deg = 0;
  LayerStrain longitudinal{}, circumferential{};
  double wall_thickening_percent = 0, base_excursion_mm = 0, apex_motion_mm = 0;
};

/// One scalar function of the reduced model's frames, with a vector as unknown.
struct FrameFunction {
  std::string frame;     ///< name of the frame: of its segment where frames are the segments
  std::string function;  ///< "1", or a product of the frame's coordinates l, c, t
  bool local_axes = false;
};

enum class Phase { filling, isovolumetric_contraction, ejection, isovolumetric_relaxation };

struct CavitySample {
  double time_ms = 0;
  double volume_mL = 0;
  double pressure_mmHg = 0;
  Phase phase = Phase::filling;
};

/// The state of all segments at one output time, in the order of BeatResult::segments.
struct Instant {
  double time_ms = 0;
  std::vector<SegmentStrain> strain;
  std::vector<SegmentFrame> frames;
  std::vector<GlobalStrain> global;              ///< of BeatResult::ventricles
  std::vector<polyaffine::Vec3> frame_unknowns;  ///< of BeatResult::frame_functions, mm
  std::vector<SegmentMechanics> mechanics;       ///< empty unless output.mechanics asks for it
  double min_det_F = 1;                          ///< smallest det F at the points of strain, against the mesh
};

struct SegmentInfo {
  int number = 0;  ///< 1–17, as in the standard
  std::string name;
  double volume_mL = 0;
  std::optional<double> activation_ms;  ///< mean activation time; none without activation
};

/// What passed through a valve in a beat, mL: forwards, and backwards through its leak, also in percent of
/// what went forwards.
struct ValveVolumes {
  std::string name;
  double forward_mL = 0, regurgitant_mL = 0, regurgitant_percent = 0;
  double mean_gradient_mmHg = 0, peak_gradient_mmHg = 0;  ///< pressure drop while blood flows forwards
};

/// What flows through a compliance of the circulation in a beat; without a change of what it holds both are
/// the same.
struct FlowBalance {
  std::string name;
  double mean_inflow_mL_per_s = 0, mean_outflow_mL_per_s = 0;
  double error_percent = 0;  ///< their difference, in percent of the inflow
};

/// The circulation of one ventricle over the last beat. Arterial: behind the outlet valve; venous: before the
/// inlet valve.
struct Haemodynamics {
  double cardiac_output_L_per_min = 0;                 ///< what leaves the ventricle and does not come back
  double stroke_work_mmHg_mL = 0, stroke_work_mJ = 0;  ///< area of the pressure-volume loop
  double dp_dt_max_mmHg_per_s = 0, dp_dt_min_mmHg_per_s = 0;  ///< of the ventricle's pressure
  double arterial_mean_mmHg = 0, arterial_systolic_mmHg = 0, arterial_diastolic_mmHg = 0;
  double venous_mean_mmHg = 0;
  std::vector<ValveVolumes> valves;  ///< inlet, outlet
  /// Stroke work and the potential energy ½ p_ES V_ES of a wall that is slack at the volume 0 (Suga 1979).
  double pressure_volume_area_mmHg_mL = 0, pressure_volume_area_mJ = 0;
  double arterial_elastance_mmHg_per_mL = 0;  ///< end-systolic pressure over stroke volume (Sunagawa 1983)
};

/// Columns with their names, all of the same length.
struct CirculationTable {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> values;  ///< one list a column
};

struct VentricleSummary {
  std::string name;  ///< "lv" or "rv"
  double edv_mL = 0, esv_mL = 0, sv_mL = 0, ef_percent = 0;
  double peak_pressure_mmHg = 0, edp_mmHg = 0;
  double ed_time_ms = 0, es_time_ms = 0;
  std::vector<CavitySample> samples;  ///< the last beat
  std::string ed_is{}, es_is{};       ///< what end diastole and end systole are here, in words (KeyStates)
  /// What leaks change of the volume in phases called isovolumetric.
  double isovolumetric_contraction_change_mL = 0, isovolumetric_relaxation_change_mL = 0;
  std::optional<Haemodynamics> haemodynamics{};  ///< of a whole beat
};

/// What the time integration of the beats took: calls, and the seconds spent in them.
struct SolveCost {
  long residuals = 0, factorisations = 0, linear_solves = 0;
  long error_test_failures = 0, convergence_failures = 0;
  double filling_s = 0;  ///< static filling before the first beat
  double residual_s = 0, tangent_s = 0, factorisation_s = 0, linear_solve_s = 0;
};

struct PlanItem {
  std::string part;
  bool built = false;
  std::string why;
};

/// The reduced state against the full-order solution at one instant: relative L2 error of the displacement,
/// signed error of the cavity volume, both in percent, and the largest difference of a segment's normal
/// strain.
/// What a tuned model tells of its own error at an instant (estimated_error).
struct EstimatedError {
  std::string instant;              ///< "ED" or "ES"
  double displacement_percent = 0;  ///< L2 over the wall
};

struct VerificationInstant {
  std::string instant;  ///< "ED" or "ES"
  double time_ms = 0;
  double displacement_error_percent = 0, volume_error_percent = 0, max_segment_strain_error = 0;
  double wall_time_s = 0;
};

/// A cavity of a heart whose mesh was imaged under pressure, and its passive filling from the stress-free
/// shape.
struct UnloadedCavity {
  std::string name;  ///< "lv" or "rv"
  double pressure_mmHg = 0, imaged_mL = 0;
  double unloaded_mL = 0, reloaded_mL = 0;         ///< free of stress, and under the pressure again
  std::vector<double> pressures_mmHg, volumes_mL;  ///< filling; of both ventricles in proportion
};

/// How the stress-free shape was found (unload), and how far the shape reloaded from it is from the image.
struct UnloadingResult {
  std::string method;  ///< "polyaffine" or "fem": what inflated
  int inflations = 0;
  double distance_mm = 0, mean_distance_mm = 0;  ///< largest and root mean square over the vertices
  double longest_way_mm = 0;                     ///< of a vertex from the image to the stress-free shape
  double wall_time_s = 0;
  std::vector<UnloadedCavity> cavities;  ///< the left ventricle's first
};

/// Everything that the tables, figures and pages tell of a run; no mesh in it.
struct BeatResult {
  std::string method;     ///< "polyaffine" or "fem"
  bool has_beat = false;  ///< false: a prescribed pressure without circulation
  bool has_contraction = false;
  int mesh_vertices = 0, mesh_tets = 0, dofs = 0, control_nodes = 0, integration_points = 0;
  int beats = 0, time_steps = 0, newton_iterations = 0;
  double simulated_time_s = 0;
  SolveCost cost;  ///< zero without a beat
  double wall_setup_s = 0, wall_solve_s = 0, wall_output_s = 0, wall_total_s = 0;
  std::vector<SegmentInfo> segments;
  std::vector<SegmentNode> nodes;              ///< of the segments
  std::vector<FrameFunction> frame_functions;  ///< empty unless output.frames asks for their unknowns
  std::vector<Instant> instants;               ///< the last beat, time counted from its start
  std::vector<VentricleSummary> ventricles;
  CirculationTable circulation;              ///< the last beat; empty without one
  std::vector<FlowBalance> balances;         ///< of it
  GlobalStrain strain;                       ///< of the left ventricle at end systole
  std::optional<GlobalStrain> right_strain;  ///< of the right free wall at the same time
  std::optional<EnergyBalance> energy;       ///< of the last beat; none without contraction
  double min_det_F = 1, max_det_F = 1;
  std::optional<UnloadingResult> unloading;      ///< of a heart imaged under pressure
  std::vector<EstimatedError> estimated_errors;  ///< of a tuned model
  std::vector<VerificationInstant> verification;
  std::vector<PlanItem> plan;
  std::vector<std::string> warnings;
  bool completed = false;
  std::string stop_reason;  ///< why a run that is not completed stopped, and when
};

}  // namespace cardiac
