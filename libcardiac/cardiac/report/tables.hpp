#pragma once

#include <filesystem>
#include <string>

#include <cardiac/report/run_info.hpp>

namespace cardiac {

/// Tables of a run as CSV text with a header row: points as decimal sign, at most 9 significant digits, an
/// empty field where a number does not exist or is not finite.
///
/// strain.csv: a row per output time and segment; normal strains Lagrangian in local axes against ED, shears
/// Green–Lagrange, dimensionless.
std::string strain_table(const BeatResult& result);
/// strain_peaks.csv: a row per segment; definitions at strain_peaks().
std::string peaks_table(const BeatResult& result);
/// affine.csv: a row per output time and segment: the affine map that comes closest to the segment's motion
/// since end diastole (without a beat: since the first state, in a passive loading the mesh), the same
/// reference as strain.csv,
///   x = q + R (A Rᵀ (y − q) + t)
/// from the end-diastolic position y of its material to the present one x, with the node's end-diastolic
/// position q and its axes R from control_nodes.csv (see AffineFit). A (local axes), t in mm; of the polar
/// decomposition A = R U the rotation angle of R and the stretches, largest first (the smallest negative in a
/// map that turns the segment inside out); the determinant of A (not the change of volume of a bent segment,
/// see AffineFit; that is in strain.csv); and the misfit, the share of the motion that no affine map holds
/// (empty where nothing has moved).
std::string affine_table(const BeatResult& result);
/// control_nodes.csv: a row per segment: end-diastolic position of its control node (mm) and its axes l
/// (longitudinal), c (circumferential) and r (radial) in the coordinates of the mesh.
std::string nodes_table(const BeatResult& result);
/// global_strain.csv: a row per output time and ventricle: means over its wall (global_strain), then what is
/// measured along contours, definitions at ContourGauge; percent, degrees, mm, since end diastole.
std::string global_strain_table(const BeatResult& result);
/// frames.csv: a row per output time and function of the reduced model, definitions at frame_functions(): the
/// frame it belongs to, the axes of its coefficient, its function of the frame's coordinates and the
/// coefficient (mm), with all digits. Against the mesh, not end diastole.
std::string frames_table(const BeatResult& result);
/// mechanics.csv: a row per output time and segment, definitions at segment_mechanics(): fibre strain since
/// end diastole, Cauchy stresses (kPa) and work (mJ).
std::string mechanics_table(const BeatResult& result);
/// cavity.csv: a row per sample of each ventricle.
std::string cavity_table(const BeatResult& result);

/// circulation.csv: the last beat, four rows a time step. Per side pressures (NAME_mmHg) and flows
/// (NAME_mL_per_s): before the inlet valve (pulmonary_veins with the left atrium, systemic_veins with the
/// right one), in the ventricle, behind the outlet valve (aorta, pulmonary_artery), of the arteries'
/// compliance; through the valves, forwards positive, and through the small vessels; and the volume of the
/// ventricle.
std::string circulation_text(const BeatResult& result);

std::string phase_name(Phase phase);

/// Time of end diastole and end systole of the left ventricle (of the first one without "lv"; KeyStates);
/// without a beat and without contraction the first and the last output time: the end of the loading takes
/// the place of end systole.
struct CardiacTimes {
  double ed_ms = 0, es_ms = 0;
};
CardiacTimes cardiac_times(const BeatResult& result);
/// Is there an end systole: a beat, or a contraction under prescribed loads.
bool has_systole(const BeatResult& result);

/// Writes strain.csv, strain_peaks.csv, affine.csv, control_nodes.csv, global_strain.csv, cavity.csv,
/// summary.json, circulation.csv (of a beat) and, where the result has them, frames.csv and mechanics.csv
/// into the folder `out` (made where missing), each file whole or not at all. Errors as of
/// polyaffine::write_atomically.
void write_tables(const BeatResult& result, const RunInfo& info, const std::filesystem::path& out);

}  // namespace cardiac
