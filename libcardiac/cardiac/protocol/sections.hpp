#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

/// The tables of a protocol. The initial values are the defaults of the protocol file, those of a healthy
/// human heart; meaning, range and source of every key stand in the key table (model_tables.cpp,
/// beat_tables.cpp) and are printed by `cardiac explain KEY`.
namespace cardiac::protocol {

using Vector3 = std::array<double, 3>;
using Labels = std::vector<std::variant<int, std::string>>;  ///< numbers or names of surfaces

enum class Shape { human_lv, land_ellipsoid, human_biventricle };
enum class LengthUnit { mm, cm, m, um };
/// Length of a unit, mm.
constexpr double mm_per_unit(LengthUnit unit) {
  constexpr std::array<double, 4> kLength{1, 10, 1000, 1e-3};
  return kLength.at(static_cast<std::size_t>(unit));
}
struct Mesh {
  std::optional<std::string> file;  ///< either file (with its length_unit) or shape
  std::optional<Shape> shape;
  std::optional<double> size_mm;  ///< edge length of a generated mesh; absent: the shape's own
  std::optional<LengthUnit> length_unit;
  std::optional<std::string> surface_file, label_array, region_array;
  std::optional<std::vector<std::string>> surface_files;  ///< NAME=FILE, one surface each
  std::optional<Labels> endo_label, epi_label, base_label, rv_endo_label, region;
};

enum class Scheme { aha17, aha29 };
struct Anatomy {
  std::optional<Scheme> scheme;               ///< absent: by the mesh; the parser sets it for a shape
  std::optional<Vector3> long_axis;           ///< apex to base; absent: found on the mesh
  std::optional<Vector3> anterior_direction;  ///< absent: by a point, else +y
  std::optional<Vector3> septum_point, rv_insertion_point, mitral_point;  ///< in the unit of the mesh
};

enum class Method { polyaffine, fem };
enum class Preset { fast, accurate };
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
  int element_order = 2;  ///< of the full-order model
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
  double bulk_modulus_kPa = 1000;                        ///< every law but saint_venant_kirchhoff
  double viscosity_kPa_ms = 100;
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

enum class ActivationMode { uniform, sites };
struct Activation {
  ActivationMode mode = ActivationMode::uniform;
  double onset_ms = 100;
  std::vector<int> site_segments;  ///< segments whose endocardial centre is a site
  std::vector<Vector3> sites_mm;   ///< further sites: the nearest vertex of the mesh
  double conduction_along_fibre_mm_per_ms = 0.6;
  double conduction_across_fibre_mm_per_ms = 0.2;
};

enum class ContractionModel { bestel_clement_sorine_simplified };
struct Contraction {
  ContractionModel model = ContractionModel::bestel_clement_sorine_simplified;
  double contractility_kPa = 155;
  double activation_rate_per_s = 5;
  double relaxation_rate_per_s = 30;
  std::optional<double> activation_duration_ms;  ///< set by the heart rate when the file does not name it
  double switch_width_ms = 5;
  double cross_fibre_fraction = 0.3;
};

struct Cavities {
  double pressure_mmHg = 0;        ///< prescribed, raised from zero
  double right_pressure_mmHg = 0;  ///< the same of the right ventricle
};

struct Circulation {
  double filling_pressure_mmHg = 10;
  double mitral_resistance_mmHg_s_per_mL = 0.01;
  double aortic_valve_resistance_mmHg_s_per_mL = 0.007;
  std::optional<double> aortic_leak_resistance_mmHg_s_per_mL;  ///< backwards; absent: the valve is tight
  double characteristic_resistance_mmHg_s_per_mL = 0.04;
  double peripheral_resistance_mmHg_s_per_mL = 1.0;
  double compliance_mL_per_mmHg = 1.3;
  double venous_pressure_mmHg = 5;
  double initial_aortic_pressure_mmHg = 75;
  double right_filling_pressure_mmHg = 5;  ///< from here on: of the closed loop of two ventricles
  double tricuspid_resistance_mmHg_s_per_mL = 0.01;
  double pulmonary_valve_resistance_mmHg_s_per_mL = 0.007;
  double pulmonary_characteristic_resistance_mmHg_s_per_mL = 0.01;
  double pulmonary_peripheral_resistance_mmHg_s_per_mL = 0.06;
  double pulmonary_compliance_mL_per_mmHg = 5;
  double pulmonary_venous_compliance_mL_per_mmHg = 16;
  double systemic_venous_compliance_mL_per_mmHg = 16;
  double initial_pulmonary_pressure_mmHg = 12;
};

enum class Base { clamped };
struct Boundary {
  Base base = Base::clamped;
  double epicardial_stiffness_kPa_per_mm = 0;  ///< along the reference normal; 0: none
};

struct Time {
  double heart_rate_bpm = 75;
  int max_beats = 10;
  double limit_cycle_tolerance_percent = 1;  ///< of the stroke volume, between two beats
  double relative_tolerance = 1e-3;
  double absolute_tolerance_mm = 1e-2;
  double absolute_tolerance_mmHg = 0.1;
  double max_step_ms = 10;
  int load_steps = 10;       ///< of a static loading
  double duration_ms = 800;  ///< simulated, without circulation
};

struct Output {
  double interval_ms = 10;
  bool tables = true, figures = true, mesh_series = true, frames = false;
};

/// Segments that differ from the rest: scar, ischaemia, late activation.
struct RegionOverride {
  std::string name;
  std::vector<int> segments;
  double tension_factor = 1, stiffness_factor = 1;
  double activation_delay_ms = 0;
  double border_width_percent = 10;  ///< of the segment's size, over which the factors blend
};

}  // namespace cardiac::protocol
