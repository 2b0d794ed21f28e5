#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include <cardiac/validation/elastodynamics_run.hpp>

namespace cardiac {

/// What the groups of the benchmark found for one component of the displacement of one point: median,
/// smallest and largest, mm, at the times of the file.
struct GroupCurves {
  polyaffine::Vector median, low, high;
};

/// The curves of all groups: of each point of a case the components x, y, z.
struct GroupEnvelope {
  polyaffine::Vector times_ms;
  std::vector<std::array<GroupCurves, 3>> points;
};

/// Reads an envelope (time_s and POINT_uC_{median,min,max}_m for C = x, y, z). Throws InputError as CsvTable.
GroupEnvelope read_envelope(const std::filesystem::path& file, const ElastodynamicsCase& problem);

/// How far a run leaves the range of the groups, over the times of the envelope that it reaches, by point and
/// component.
struct Excess {
  double largest_mm = 0;        ///< beyond the range
  double at_ms = 0;             ///< where
  double share_inside = 1;      ///< of the times, within kCurveTolerance_mm of the range
  double rms_to_median_mm = 0;  ///< root mean square
};
inline constexpr double kCurveTolerance_mm = 0.05;
std::vector<std::array<Excess, 3>> excess(const ElastodynamicsRun& run, const GroupEnvelope& envelope);

/// A model's motion as it is drawn: name, colour, run.
struct DrawnRun {
  std::string name, colour;
  const ElastodynamicsRun* run;
};

/// Displacement of each point along each axis against time: the groups' range and median, and the runs.
std::string elastodynamics_svg(const ElastodynamicsCase& problem, const GroupEnvelope& envelope,
                               const std::vector<DrawnRun>& runs);

/// The same numbers: time_ms, method, and for each point u_x, u_y, u_z in mm, and the cavities in mL.
std::string elastodynamics_csv(const ElastodynamicsCase& problem, const std::vector<DrawnRun>& runs);

}  // namespace cardiac
