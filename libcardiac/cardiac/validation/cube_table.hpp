#pragma once

#include <string>
#include <vector>

#include <cardiac/validation/cube_compression.hpp>

namespace cardiac {

/// One cell of the paper's Table 1.
struct PaperCell {
  int zones = 0, points = 0;
  double seconds = 0;         ///< on the paper's machine
  double error_percent = 0;   ///< of the thickness against FEM
  double spread_percent = 0;  ///< the ± beside it: tilting of the faces
  double time_ratio() const;  ///< to the paper's FEM, 2.41 s
};

/// All fifteen, by zones and then points.
const std::vector<PaperCell>& paper_table();

/// Statistics of one method over random placements. Percentages are of the thickness change of linear finite
/// elements on the same mesh.
struct CubeRow {
  PaperCell paper;
  CubeMethod method;
  CubeWeights weights = CubeWeights::volumes;
  int placements = 0;
  int redraws = 0;            ///< sets of points drawn anew because no consistent weights exist for them
  double error_percent = 0;   ///< |mean| of the signed error of the thickness
  double spread_percent = 0;  ///< its standard deviation over the placements
  double worst_percent = 0;   ///< its largest absolute value
  double tilt_percent = 0;    ///< mean over the placements of the largest tilt of the faces
  double solve_s = 0;         ///< mean processor time of a solution
  double time_ratio = 0;      ///< solve_s over that of linear finite elements, measured in between
  double placement_s = 0;     ///< mean processor time of zones and integration points
  double setup_s = 0;         ///< mean processor time of shape functions and tables
  double correction_s = 0;    ///< and of the consistent weights (0 for volumes)
  double moments_kept = 0;    ///< share of placements whose weights keep the first moments of every zone
};

/// Spurious forces of one placement with volumes as weights, and the tilt that goes with them.
struct CubeDefect {
  int zones = 0, points = 0;
  double defect = 0;  ///< CubeReduction::defect
  double tilt_percent = 0;
  double unexplained = 0;  ///< part of the thickness and tilt error that is not the response to the defect
};

struct CubeTable {
  std::vector<CubeRow> rows;
  std::vector<CubeDefect> defects;
  const CubeRow& row(const PaperCell& cell, const CubeMethod& method, CubeWeights weights) const;
};

/// Adds the rows of a cell, computed on one thread: `methods` with both kinds of weights, over `placements`
/// random placements that depend on the cell only, and the defects of direct blending with order 0.
void run_cube_cell(const CubeScene& scene, const PaperCell& cell, const std::vector<CubeMethod>& methods,
                   int placements, CubeTable& table);

/// Correlation coefficient of the logarithms of defect and tilt over all placements.
double defect_correlation(const std::vector<CubeDefect>& defects);

std::string cube_csv(const CubeTable& table);

}  // namespace cardiac
