#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <cardiac/report/run_info.hpp>

namespace cardiac {

struct Figure {
  std::string file;  ///< its name in the result folder
  std::string svg;
};

/// When the segments of a result are activated: the earliest and the latest mean time of a segment, ms. None
/// without activation.
struct ActivationSpan {
  double first_ms = 0, last_ms = 0;
  /// Less than 1 ms apart: a picture would show rounding.
  bool uniform() const { return last_ms - first_ms < 1; }
};
std::optional<ActivationSpan> activation_span(const BeatResult& result);

/// Bull's-eyes of the left ventricle (segments 1–17): end-systolic strain (bullseye_longitudinal.svg and so
/// on), the peak over the beat (bullseye_peak_*.svg), and the activation time unless it is the same
/// everywhere (bullseye_activation.svg); of the right free wall, where the result has it, end-systolic strain
/// (bullseye_right_*.svg). Without a beat the strain at the end, and no peaks. Regions of the protocol are
/// outlined.
std::vector<Figure> bullseye_figures(const BeatResult& result, const RunInfo& info);

/// All figures that the result has data for: those above, strain_curves.svg, strain_curves_right.svg,
/// time_curves.svg and pv_loop.svg.
std::vector<Figure> figures(const BeatResult& result, const RunInfo& info);

/// Writes figures() into the folder `out` (made where missing), each whole or not at all, and removes figures
/// of an earlier run there that this result has no data for. Errors as of polyaffine::write_atomically.
void write_figures(const BeatResult& result, const RunInfo& info, const std::filesystem::path& out);

}  // namespace cardiac
