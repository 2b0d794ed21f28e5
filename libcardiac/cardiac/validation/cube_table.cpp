#include "cardiac/validation/cube_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <cardiac/report/text.hpp>

namespace cardiac {
namespace {

constexpr int kRepeats = 5;  // of each timed solution; the quickest counts
constexpr std::array kBothWeights{CubeWeights::volumes, CubeWeights::consistent};

struct Sums {
  int n = 0;
  double error = 0, square = 0, worst = 0, tilt = 0;

  void add(double e, double t) {
    ++n;
    error += e;
    square += e * e;
    worst = std::max(worst, std::abs(e));
    tilt += t;
  }
  void write(CubeRow& row) const {
    const double mean = error / n;
    row.placements = n;
    row.error_percent = std::abs(mean);
    row.spread_percent = std::sqrt(std::max(0.0, square / n - mean * mean));
    row.worst_percent = worst;
    row.tilt_percent = tilt / n;
  }
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
  double fem_s = std::numeric_limits<double>::infinity();
  for (int k = 0; k < placements; ++k) {
    const CubeSolution fem = solve_cube_fem(scene, 1);
    fem_s = std::min(fem_s, fem.solve_s);
    const CubePlacement placement = place_cube(scene, cell.zones, cell.points, random);
    for (std::size_t r = 0; r < rows.size(); r += kBothWeights.size()) {
      const CubeReduction reduction(scene, placement, rows[r].method);
      for (std::size_t w = 0; w < kBothWeights.size(); ++w) {
        const CubeSolution solution = reduction.solve(kBothWeights[w], kRepeats);
        const CubeThickness error = solution.thickness - fem.thickness;
        sums[r + w].add(percent(-error.change, fem.thickness), percent(error.tilt(), fem.thickness));
        rows[r + w].solve_s += solution.solve_s / placements;
        rows[r + w].setup_s += reduction.setup_s() / placements;
        if (kBothWeights[w] == CubeWeights::consistent) {
          rows[r + w].correction_s += reduction.correction_s() / placements;
          rows[r + w].moments_kept += static_cast<double>(reduction.keeps_moments()) / placements;
        } else if (rows[r].method == CubeMethod() && cell.zones > 1) {
          table.defects.push_back(diagnose(cell, reduction, error, fem.thickness));
        }
        rows[r + w].redraws += placement.redraws;
      }
    }
  }
  for (std::size_t r = 0; r < rows.size(); ++r) {
    sums[r].write(rows[r]);
    rows[r].time_ratio = rows[r].solve_s / fem_s;
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
  std::string out =
      "zones,points,kinematics,elaston_order,weights,placements,error_percent,spread_percent,worst_percent,"
      "tilt_percent,solve_s,time_ratio,setup_s,correction_s,moments_kept,redraws,paper_error_percent,"
      "paper_spread_percent,paper_time_ratio\n";
  for (const CubeRow& r : table.rows) {
    out += std::to_string(r.paper.zones) + "," + std::to_string(r.paper.points);
    out += r.method.kinematics == CubeKinematics::blending ? ",blending," : ",gmls,";
    out += std::to_string(r.method.elaston_order);
    out += r.weights == CubeWeights::volumes ? ",volumes," : ",consistent,";
    out += std::to_string(r.placements);
    for (const double value : {r.error_percent, r.spread_percent, r.worst_percent, r.tilt_percent, r.solve_s,
                               r.time_ratio, r.setup_s, r.correction_s, r.moments_kept})
      (out += ",") += number_text(value);
    out += "," + std::to_string(r.redraws);
    for (const double value : {r.paper.error_percent, r.paper.spread_percent, r.paper.time_ratio()})
      (out += ",") += number_text(value);
    out += "\n";
  }
  return out;
}

}  // namespace cardiac
