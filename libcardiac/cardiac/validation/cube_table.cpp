#include "cardiac/validation/cube_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <cardiac/report/csv_writer.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/core/single_thread.hpp>

namespace cardiac {
namespace {

constexpr int kMostDraws = 50;
constexpr int kRepeats = 5;  // of each timed solution; the quickest counts
constexpr std::array kBothWeights{CubeWeights::volumes, CubeWeights::consistent};

struct Sums {
  double error = 0, square = 0;
};

double percent(double of_mm, const CubeThickness& fem) {
  return 100 * of_mm / std::abs(fem.change);
}

CubeDefect diagnose(const PaperCell& cell, const CubeReduction& reduction, const CubeThickness& error,
                    const CubeThickness& fem) {
  const CubeThickness rest = error - reduction.defect_response();
  const double size = std::abs(error.change) + error.tilt();
  return {cell.zones, cell.points, reduction.defect(), percent(error.tilt(), fem),
          (std::abs(rest.change) + rest.tilt()) / size};
}

// Solves one placement and adds it to the sums of its row, which `finish` turns into means.
CubeThickness record(const CubeReduction& reduction, CubeWeights weights, const CubeThickness& fem,
                     CubeRow& row, Sums& sums) {
  const CubeSolution solution = reduction.solve(weights, kRepeats);
  const CubeThickness error = solution.thickness - fem;
  const double change = percent(-error.change, fem);
  sums.error += change;
  sums.square += change * change;
  ++row.placements;
  row.worst_percent = std::max(row.worst_percent, std::abs(change));
  row.tilt_percent += percent(error.tilt(), fem);
  row.solve_s += solution.solve_s;
  row.setup_s += reduction.setup_s();
  if (weights == CubeWeights::consistent) {
    row.correction_s += reduction.correction_s();
    row.moments_kept += reduction.keeps_moments() ? 1 : 0;
  }
  return error;
}

void finish(const Sums& sums, CubeRow& row) {
  const double n = row.placements, mean = sums.error / n;
  row.error_percent = std::abs(mean);
  row.spread_percent = std::sqrt(std::max(0.0, sums.square / n - mean * mean));
  for (double* sum : {&row.tilt_percent, &row.solve_s, &row.setup_s, &row.correction_s, &row.moments_kept})
    *sum /= n;
}

// Other integration points in the same zones, until there are consistent weights for them. The placements
// that follow do not depend on these draws: `random` is a copy.
CubeReduction draw_consistent(const CubeScene& scene, CubePlacement placement, const CubeMethod& method,
                              std::mt19937_64 random, CubeRow& row) {
  for (int draw = 0; draw < kMostDraws; ++draw) {
    ++row.redraws;
    placement.integration = polyaffine::integration_regions(
        scene.solver, placement.zone, placement.num_zones(), placement.integration.points.size(), random);
    CubeReduction reduction(scene, placement, method);
    if (reduction.is_consistent()) return reduction;
  }
  throw polyaffine::ComputationError("cube: found no integration points with consistent weights in " +
                                     std::to_string(kMostDraws) + " draws");
}

}  // namespace

double PaperCell::time_ratio() const {
  return seconds / 2.41;
}

const std::vector<PaperCell>& paper_table() {
  static const std::vector<PaperCell> table{
      {1, 200, 0.088, 0, 0},          {1, 500, 0.116, 0, 0},          {1, 800, 0.144, 0, 0},
      {1, 1100, 0.173, 0, 0},         {1, 1400, 0.204, 0, 0},         {5, 200, 0.575, 3.796, 9.864},
      {5, 500, 0.891, 1.142, 1.297},  {5, 800, 1.125, 0.312, 1.228},  {5, 1100, 1.409, 0.104, 1.203},
      {5, 1400, 1.293, 0.081, 0.272}, {9, 200, 1.157, 4.511, 4.469},  {9, 500, 1.823, 2.192, 3.987},
      {9, 800, 2.263, 0.646, 1.608},  {9, 1100, 2.669, 0.115, 1.064}, {9, 1400, 2.402, 0.081, 0.380}};
  return table;
}

const CubeRow& CubeTable::row(const PaperCell& cell, const CubeMethod& method, CubeWeights weights) const {
  for (const CubeRow& r : rows)
    if (r.paper.zones == cell.zones && r.paper.points == cell.points && r.method == method &&
        r.weights == weights)
      return r;
  throw std::invalid_argument("cube table: no such row");
}

void run_cube_cell(const CubeScene& scene, const PaperCell& cell, const std::vector<CubeMethod>& methods,
                   int placements, CubeTable& table) {
  const polyaffine::SingleThread single_thread;
  std::mt19937_64 random(static_cast<unsigned>(10000 * cell.zones + cell.points));
  std::vector<CubeRow> rows;
  for (const CubeMethod& method : methods)
    for (const CubeWeights weights : kBothWeights) {
      CubeRow row;
      row.paper = cell;
      row.method = method;
      row.weights = weights;
      rows.push_back(row);
    }
  std::vector<Sums> sums(rows.size());
  double placement_s = 0, fem_s = std::numeric_limits<double>::infinity();
  for (int k = 0; k < placements; ++k) {
    const CubeSolution fem = solve_cube_fem(scene, 1);
    fem_s = std::min(fem_s, fem.solve_s);
    const double start = polyaffine::processor_seconds();
    const CubePlacement placement = place_cube(scene, cell.zones, cell.points, random);
    placement_s += (polyaffine::processor_seconds() - start) / placements;
    for (std::size_t r = 0; r < rows.size(); r += kBothWeights.size()) {
      const CubeReduction first(scene, placement, rows[r].method);
      const CubeThickness error = record(first, CubeWeights::volumes, fem.thickness, rows[r], sums[r]);
      if (rows[r].method == CubeMethod() && cell.zones > 1)
        table.defects.push_back(diagnose(cell, first, error, fem.thickness));
      if (first.is_consistent()) {
        record(first, CubeWeights::consistent, fem.thickness, rows[r + 1], sums[r + 1]);
        continue;
      }
      const CubeReduction other = draw_consistent(scene, placement, rows[r].method, random, rows[r + 1]);
      record(other, CubeWeights::consistent, fem.thickness, rows[r + 1], sums[r + 1]);
    }
  }
  for (std::size_t r = 0; r < rows.size(); ++r) {
    finish(sums[r], rows[r]);
    rows[r].time_ratio = rows[r].solve_s / fem_s;
    rows[r].placement_s = placement_s;
    table.rows.push_back(rows[r]);
  }
}

double defect_correlation(const std::vector<CubeDefect>& defects) {
  const auto n = static_cast<Eigen::Index>(defects.size());
  polyaffine::Vector x(n), y(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    x[i] = std::log(defects[i].defect);
    y[i] = std::log(defects[i].tilt_percent);
  }
  x.array() -= x.mean();
  y.array() -= y.mean();
  return x.dot(y) / (x.norm() * y.norm());
}

std::string cube_csv(const CubeTable& table) {
  CsvWriter csv(
      "zones,points,kinematics,elaston_order,weights,placements,error_percent,spread_percent,worst_percent,"
      "tilt_percent,solve_s,time_ratio,placement_s,setup_s,correction_s,moments_kept,redraws,"
      "paper_error_percent,paper_spread_percent,paper_time_ratio");
  for (const CubeRow& r : table.rows) {
    csv << r.paper.zones << r.paper.points
        << (r.method.kinematics == CubeKinematics::blending ? "blending" : "gmls") << r.method.elaston_order
        << (r.weights == CubeWeights::volumes ? "volumes" : "consistent") << r.placements << r.error_percent
        << r.spread_percent << r.worst_percent << r.tilt_percent << r.solve_s << r.time_ratio << r.placement_s
        << r.setup_s << r.correction_s << r.moments_kept << r.redraws << r.paper.error_percent
        << r.paper.spread_percent << r.paper.time_ratio();
    csv.end_row();
  }
  return csv.text();
}

}  // namespace cardiac
