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
/// affine.csv: a row per output time and segment with a frame: A (local axes), t in mm, and of the polar
/// decomposition A = R U the rotation angle of R and the stretches, largest first; in a frame that is turned
/// inside out the smallest stretch is negative.
std::string affine_table(const BeatResult& result);
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

/// Writes strain.csv, strain_peaks.csv, affine.csv, cavity.csv, circulation.csv (of a beat) and summary.json
/// into the folder `out` (made where missing), each file whole or not at all. Errors as of
/// polyaffine::write_atomically.
void write_tables(const BeatResult& result, const RunInfo& info, const std::filesystem::path& out);

}  // namespace cardiac
