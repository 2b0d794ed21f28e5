#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <cardiac/anatomy/anatomy.hpp>
#include <cardiac/core/units.hpp>

namespace cardiac {
struct TunedModel;
struct CirculationNetwork;
struct ActivationMap;
struct GivenCurve;
struct GivenCavities;
}  // namespace cardiac

/// The parts of a scene, in mm, ms, kPa and mg. Their initial values are those of a healthy human heart, the
/// defaults of the protocol file; meaning, range and source of each stand in the protocol's key table and are
/// printed by `cardiac explain KEY`.
namespace cardiac::scene {

using Vector3 = std::array<double, 3>;

/// The pressures of the cavities under which the heart has the shape that its mesh has, as of an image.
struct ImagedUnder {
  double pressure_kPa = 0, right_pressure_kPa = 0;
};

enum class Method { polyaffine, fem };
enum class Preset { fast, accurate, tuned };
enum class Weights { sigmoid, tents };
enum class PressureSpace { none, segment, segment_depth, segment_linear, segment_bilinear };
enum class Axes { heart, cartesian, automatic };
enum class Integration { cells, gauss, trained };
struct Reduction {
  Method method = Method::polyaffine;
  Preset preset = Preset::fast;
  Weights weights = Weights::tents;
  double sigmoid_slope = 2.25;
  std::optional<std::vector<std::string>> enrichment;  ///< set by the preset when the file does not name it
  std::optional<PressureSpace> pressure_space;         ///< set by the preset when the file does not name it
  std::optional<bool> border_functions;                ///< set by the preset when the file does not name it
  double local_bulk_modulus_kPa = 6;  ///< at every integration point; raised where muscle contracts
  Axes axes = Axes::automatic;
  std::vector<int> ring_nodes = {4, 6, 6};  ///< control nodes of each ring, apex to base, beside the cap's
  std::optional<std::vector<double>> ring_positions;   ///< apicobasal, 0 apex to 1 base
  std::optional<std::vector<double>> ring_angles_deg;  ///< rotational, of each ring's first node
  Integration integration = Integration::cells;
  int element_order = 2;        ///< of the full-order model
  bool affine_frames = false;   ///< from here on of the tuned preset: frames stay unknowns beside the modes
  double accuracy_percent = 1;  ///< of displacement against full order
  double budget_s = 900;        ///< time that its training may take
};

enum class TissueLaw { guccione, holzapfel_ogden, neo_hookean, mooney_rivlin, saint_venant_kirchhoff };
struct Tissue {
  TissueLaw law = TissueLaw::guccione;
  double C_kPa = 2, bf = 8, bt = 2, bfs = 20;            ///< guccione
  double a_kPa = 0.059, b = 8.023;                       ///< holzapfel_ogden, matrix
  double a_f_kPa = 18.472, b_f = 16.026;                 ///< fibres
  double a_s_kPa = 2.481, b_s = 11.12;                   ///< sheets
  double a_fs_kPa = 0.216, b_fs = 11.436;                ///< fibre–sheet shear
  double mu_kPa = 3.356;                                 ///< neo_hookean
  double c1_kPa = 1.5, c2_kPa = 0.2;                     ///< mooney_rivlin
  double youngs_modulus_kPa = 10, poisson_ratio = 0.49;  ///< saint_venant_kirchhoff
  double bulk_modulus_kPa = 10000;                       ///< every law but saint_venant_kirchhoff
  double viscosity_kPa_ms = 100;
  double density_mg_per_mm3 = 0;  ///< 0: no inertia
};

enum class FibreSource { rule, file };
enum class FibreRule { helix };
struct Fibres {
  FibreSource source = FibreSource::rule;
  std::optional<std::string> fibre_array, sheet_array;  ///< of the mesh file; absent: the usual names
  FibreRule rule = FibreRule::helix;
  double endo_angle_deg = 70, epi_angle_deg = -70;        ///< from circumferential towards the base
  double sheet_angle_deg = 0;                             ///< of the sheet direction from the wall normal
  double rv_endo_angle_deg = 70, rv_epi_angle_deg = -70;  ///< in the right free wall
};

enum class ActivationMode { uniform, sites, array, table };
struct Activation {
  ActivationMode mode = ActivationMode::uniform;
  double onset_ms = 100;
  std::vector<int> site_segments;  ///< segments whose endocardial centre is a site
  std::vector<Vector3> sites_mm;   ///< further sites: the nearest vertex of the mesh
  double conduction_along_fibre_mm_per_ms = 0.6;
  double conduction_across_fibre_mm_per_ms = 0.2;
  std::optional<std::string> array_ms{}, array_s{};  ///< name of a point array of the mesh file
  std::optional<std::string> file{};                 ///< a table of points and their times
  std::shared_ptr<const ActivationMap> map{};        ///< what the array or the table says; null: not read yet
};

enum class ContractionModel { bestel_clement_sorine_simplified, table, bestel_clement_sorine, land_2017 };
struct Contraction {
  ContractionModel model = ContractionModel::bestel_clement_sorine_simplified;
  double contractility_kPa = 150;
  double activation_rate_per_ms = 0.005;
  double relaxation_rate_per_ms = 0.03;
  std::optional<double> activation_duration_ms;  ///< set by the heart rate when the file does not name it
  double switch_width_ms = 5;
  double cross_fibre_fraction = 0.25;
  std::optional<std::string> tension_file{};    ///< of the model table
  std::shared_ptr<const GivenCurve> tension{};  ///< what it says, kPa from the excitation of a point on
  std::optional<double> time_factor{};  ///< on all times but those that are given; set by the heart rate
  double overlap_slope = 2.3;           ///< β₀, from here on of models that feel the fibre
  std::optional<double> bridge_stiffness_kPa{};  ///< set by contractility_kPa when the file does not name it
  double series_stiffness_kPa = 1e5, bridge_viscosity_kPa_ms = 70, rate_destruction = 12;
  double reference_tension_kPa = 120;  ///< from here on of land_2017
  double calcium_50_uM = 0.805, calcium_slope_uM = -2.4;
  double diastolic_calcium_uM = 0.1, peak_calcium_uM = 0.9;
  std::optional<double> calcium_rise_ms{}, calcium_decay_ms{};  ///< set by the heart rate
  std::optional<std::string> calcium_file{};
  std::shared_ptr<const GivenCurve> calcium{};  ///< what it says, µM since excitation

  /// Is the tension more than a function of time?
  bool feels_fibre() const {
    return model == ContractionModel::bestel_clement_sorine || model == ContractionModel::land_2017;
  }
};

enum class Repeats { automatic, yes, no };
struct Cavities {
  double pressure_kPa = 0;                                    ///< prescribed, raised from zero
  double right_pressure_kPa = 0;                              ///< the same of the right ventricle
  std::optional<std::string> pressure_file{}, volume_file{};  ///< either of them instead
  Repeats repeats =
      Repeats::automatic;  ///< whether what the file gives is one beat; automatic: by its length
  std::shared_ptr<const GivenCavities> curves{};  ///< what the file says
};

enum class Loop { windkessel, closed_2022, network, svzerod };
enum class SvZeroDUnits { mmHg_mL_s, dyn_cm_s, Pa_m_s };  ///< of pressure, length or volume, and time
struct Circulation {
  Loop loop = Loop::windkessel;
  double filling_pressure_kPa = 10 * kPa_per_mmHg;
  double mitral_resistance_kPa_ms_per_mm3 = 0.01 * resistance_per_mmHg_s_per_mL;
  double aortic_valve_resistance_kPa_ms_per_mm3 = 0.007 * resistance_per_mmHg_s_per_mL;
  std::optional<double> aortic_leak_resistance_kPa_ms_per_mm3;  ///< backwards; absent: the valve is tight
  double characteristic_resistance_kPa_ms_per_mm3 = 0.04 * resistance_per_mmHg_s_per_mL;
  double peripheral_resistance_kPa_ms_per_mm3 = 1.0 * resistance_per_mmHg_s_per_mL;
  double compliance_mm3_per_kPa = 1.3 * compliance_per_mL_per_mmHg;
  double venous_pressure_kPa = 5 * kPa_per_mmHg;
  double initial_aortic_pressure_kPa = 75 * kPa_per_mmHg;
  double right_filling_pressure_kPa =
      5 * kPa_per_mmHg;  ///< from here on: of the closed loop of two ventricles
  double tricuspid_resistance_kPa_ms_per_mm3 = 0.01 * resistance_per_mmHg_s_per_mL;
  double pulmonary_valve_resistance_kPa_ms_per_mm3 = 0.007 * resistance_per_mmHg_s_per_mL;
  double pulmonary_characteristic_resistance_kPa_ms_per_mm3 = 0.01 * resistance_per_mmHg_s_per_mL;
  double pulmonary_peripheral_resistance_kPa_ms_per_mm3 = 0.06 * resistance_per_mmHg_s_per_mL;
  double pulmonary_compliance_mm3_per_kPa = 5 * compliance_per_mL_per_mmHg;
  double pulmonary_venous_compliance_mm3_per_kPa = 16 * compliance_per_mL_per_mmHg;
  double systemic_venous_compliance_mm3_per_kPa = 16 * compliance_per_mL_per_mmHg;
  double initial_pulmonary_pressure_kPa = 12 * kPa_per_mmHg;
  std::optional<double> mitral_leak_resistance_kPa_ms_per_mm3{};  ///< from here on of both: absent: tight
  std::optional<double> tricuspid_leak_resistance_kPa_ms_per_mm3{};
  std::optional<double> pulmonary_leak_resistance_kPa_ms_per_mm3{};
  double mitral_stenosis_kPa_ms2_per_mm6 = 0, aortic_stenosis_kPa_ms2_per_mm6 = 0;  ///< of q²
  double tricuspid_stenosis_kPa_ms2_per_mm6 = 0, pulmonary_stenosis_kPa_ms2_per_mm6 = 0;
  std::optional<SvZeroDUnits> svzerod_units{};
  std::optional<std::string> svzerod_file{};              ///< of the loop svzerod
  std::optional<std::string> lv_chamber{}, rv_chamber{};  ///< chambers of that file that the mesh stands for
  std::shared_ptr<const CirculationNetwork> network{};    ///< of the loops network and svzerod
};

enum class Base { clamped, elastic, sliding };
enum class SupportDirections { normal, all };
enum class HeightLaw { linear, smooth };
struct Boundary {
  Base base = Base::clamped;
  double base_normal_stiffness_kPa_per_mm = 0.1;  ///< from here on per reference area of an elastic base
  double base_normal_damping_kPa_ms_per_mm = 5;
  double base_inplane_stiffness_kPa_per_mm = 0.1;
  double base_inplane_damping_kPa_ms_per_mm = 5;
  double epicardial_stiffness_kPa_per_mm = 0;                           ///< 0: none
  double epicardial_damping_kPa_ms_per_mm = 0;                          ///< 0: none
  SupportDirections epicardial_directions = SupportDirections::normal;  ///< of the reference surface
  double epicardial_apex_weight = 1, epicardial_base_weight = 1;  ///< factors by height along the long axis
  HeightLaw epicardial_weight_law = HeightLaw::linear;            ///< between them
  std::optional<std::string> epicardial_weight_array;             ///< of the mesh file's points; absent: 1

  bool base_moves() const { return base != Base::clamped; }
  /// Do springs or dashpots act on the epicardium, or on the base?
  bool holds_epicardium() const {
    return epicardial_stiffness_kPa_per_mm > 0 || epicardial_damping_kPa_ms_per_mm > 0;
  }
  bool holds_base() const {
    return base == Base::elastic &&
           (base_normal_stiffness_kPa_per_mm > 0 || base_normal_damping_kPa_ms_per_mm > 0 ||
            base_inplane_stiffness_kPa_per_mm > 0 || base_inplane_damping_kPa_ms_per_mm > 0);
  }
};

struct Time {
  double beat_ms = 800;  ///< between two beats
  int max_beats = 10;
  double limit_cycle_tolerance_percent = 1;  ///< of the stroke volume, between two beats
  double relative_tolerance = 1e-3;
  double absolute_tolerance_mm = 1e-2;
  double absolute_tolerance_kPa = 0.1 * kPa_per_mmHg;
  double max_step_ms = 10;
  int load_steps = 10;       ///< of a static loading
  double duration_ms = 800;  ///< simulated, without circulation
};

struct Output {
  double interval_ms = 10;
  bool tables = true, figures = true, mesh_series = true, frames = false, mechanics = false;
};

/// Segments that differ from the rest: scar, ischaemia, late activation.
struct RegionOverride {
  std::string name;
  std::vector<int> segments;
  double tension_factor = 1, stiffness_factor = 1;
  double activation_delay_ms = 0;
  double border_width_percent = 10;  ///< of the segment's size, over which the factors blend
};

}  // namespace cardiac::scene

namespace cardiac {

/// What a run is about: a heart, what it consists of, what drives and holds it, and how finely it is computed
/// and told. A part that is absent is not built. A value may be put together in C++ or be read from a text
/// (load_protocol).
struct Scene {
  std::shared_ptr<const Anatomy> heart;      ///< the mesh with coordinates and segments; needed by simulate
  std::optional<scene::ImagedUnder> imaged;  ///< absent: the heart is free of stress (see unload)
  std::shared_ptr<const TunedModel> tuned;   ///< learned for it before; null: preset tuned learns it
  scene::Reduction reduction;
  scene::Tissue tissue;
  std::optional<scene::Fibres> fibres;
  std::optional<scene::Activation> activation;
  std::optional<scene::Contraction> contraction;
  std::optional<scene::Cavities> cavities;
  std::optional<scene::Circulation> circulation;
  scene::Boundary boundary;
  scene::Time time;
  scene::Output output;
  std::vector<scene::RegionOverride> regions;
};

}  // namespace cardiac
