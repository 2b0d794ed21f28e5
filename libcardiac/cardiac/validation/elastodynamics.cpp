#include "cardiac/validation/elastodynamics.hpp"

#include <cmath>
#include <sstream>

#include <cardiac/anatomy/structured_ellipsoid.hpp>
#include <cardiac/validation/elastodynamics_curves.hpp>
#include <polyaffine/core/atomic_file.hpp>
#include <polyaffine/core/error.hpp>

namespace cardiac {
namespace {

constexpr auto kSource = "Aróstica et al. 2025, CMAME 435:117485, ten groups";
constexpr auto kFullOrder = "full order on the same tets";

const char* const kFolder = "data/arostica2025";
// The quick set: to the peak, on a mesh with a fifth of the benchmark's tets, which follow the surfaces less.
constexpr double kQuickEnd_ms = 500, kQuickExcess_mm = 1.5;
constexpr StructuredCells kQuickCells{20, 30, 1};

// The rows of one model of a problem.
class Rows {
 public:
  Rows(const ElastodynamicsCase& problem, const std::string& method, const ElastodynamicsRun& run)
      : run_(run) {
    row_.case_name = problem.name;
    row_.method = method;
    row_.wall_time_s = run.wall_s;
    row_.record = CheckRecord{static_cast<int>(run.steps),
                              static_cast<int>(run.newton_iterations),
                              0,
                              run.times_ms.size() > 0 ? run.times_ms[run.times_ms.size() - 1] : 0,
                              run.completed(),
                              run.completed() ? "completed" : run.stop_reason};
  }

  void add(const std::string& quantity, const std::string& unit, double value, double reference, double low,
           double high, const std::string& source, std::vector<Check>& checks) const {
    Check row = row_;
    row.quantity = quantity;
    row.unit = unit;
    row.value = run_.completed() ? value : std::nan("");
    row.reference = reference;
    row.low = low;
    row.high = high;
    row.source = source;
    checks.push_back(std::move(row));
  }

 private:
  const ElastodynamicsRun& run_;
  Check row_;
};

std::string source_of(const ElastodynamicsCase& problem) {
  std::string out = kSource;
  if (problem.slack_percent > 0)
    out += "; their range widened by " + std::to_string(std::lround(problem.slack_percent)) +
           " % for linear elements";
  return out;
}

// Of the displacement along x, with its sign.
double peak_ux(const ElastodynamicsRun& run, std::size_t point) {
  const auto ux = run.displacements[point].row(0);
  Eigen::Index at = 0;
  ux.cwiseAbs().maxCoeff(&at);
  return ux[at];
}

void check_full_order(const ElastodynamicsCase& problem, const std::string& method,
                      const ElastodynamicsRun& run, const GroupEnvelope& envelope, double most_excess_mm,
                      std::vector<Check>& checks) {
  const Rows rows(problem, method, run);
  for (std::size_t p = 0; p < problem.points.size(); ++p) {
    const BenchmarkPoint& point = problem.points[p];
    const double slack = problem.slack_percent / 100 * std::abs(point.peak_ux_mm);
    rows.add(point.name + "_peak_ux_mm", "mm", peak_ux(run, p), point.peak_ux_mm, point.peak_low_mm - slack,
             point.peak_high_mm + slack, source_of(problem), checks);
  }
  if (problem.rest_volume_mL > 0) {
    rows.add("rest_volume_mL", "mL", run.volumes_mL(0, 0), problem.rest_volume_mL,
             0.99 * problem.rest_volume_mL, 1.01 * problem.rest_volume_mL, kSource, checks);
    rows.add("least_volume_mL", "mL", run.volumes_mL.row(0).minCoeff(),
             0.5 * (problem.least_volume_low_mL + problem.least_volume_high_mL), problem.least_volume_low_mL,
             problem.least_volume_high_mL, kSource, checks);
  }
  const auto found = excess(run, envelope);
  constexpr const char* kComponents[] = {"ux", "uy", "uz"};
  for (std::size_t p = 0; p < found.size(); ++p)
    for (std::size_t k = 0; k < 3; ++k)
      rows.add(problem.points[p].name + '_' + kComponents[k] + "_beyond_range_mm", "mm",
               found[p][k].largest_mm, 0, 0, most_excess_mm,
               std::string(kSource) + ": how far the whole curve lies beyond their range" +
                   (problem.slack_percent > 0 ? ", which linear elements do not keep" : ""),
               checks);
}

// Against full order; what is accepted is about 1.3 times what is reached.
void check_reduced(const ElastodynamicsCase& problem, const std::string& method, const ElastodynamicsRun& run,
                   const ElastodynamicsRun& full, double percent, std::vector<Check>& checks) {
  const Rows rows(problem, method, run);
  for (std::size_t p = 0; p < problem.points.size(); ++p) {
    const double truth = peak_ux(full, p);
    rows.add(problem.points[p].name + "_peak_ux_error_percent", "%", 100 * (peak_ux(run, p) / truth - 1), 0,
             -percent, percent, kFullOrder, checks);
  }
  const double rest = full.volumes_mL(0, 0), truth = full.volumes_mL.row(0).minCoeff();
  rows.add("least_volume_error_percent", "%", 100 * (run.volumes_mL.row(0).minCoeff() - truth) / rest, 0,
           -percent, percent, kFullOrder, checks);
}

}  // namespace

std::vector<Check> validate_elastodynamics(const ValidationContext& context) {
  std::vector<Check> checks;
  const auto folder = context.hearts / kFolder;
  for (const ElastodynamicsCase& problem : elastodynamics_cases()) {
    if (context.quick && &problem != &elastodynamics_cases().front()) break;
    std::shared_ptr<const Anatomy> anatomy;
    GroupEnvelope envelope;
    try {
      anatomy = elastodynamics_anatomy(problem, folder);
      envelope = read_envelope(folder / problem.envelope, problem);
    } catch (const polyaffine::InputError& error) {
      if (context.named) throw;
      context.left_out(error.what());
      return checks;
    }
    if (context.quick) anatomy = structured_benchmark_ventricle(kQuickCells);
    const double end_ms = context.quick ? kQuickEnd_ms : problem.end_ms;
    const ElastodynamicsMethod full{.element_order = problem.element_order, .end_ms = end_ms},
        reduced{.method = scene::Method::polyaffine, .end_ms = end_ms};
    const auto run = [&](const std::string& what, const ElastodynamicsMethod& method) {
      return run_elastodynamics(problem, anatomy, method, [&](double fraction) {
        context.progress(problem.name + ", " + what, fraction);
      });
    };
    const ElastodynamicsRun truth = run("full order", full);
    const std::string name =
        "fem_p" + std::to_string(problem.element_order) + ' ' + std::to_string(truth.tets) + " tets";
    check_full_order(problem, name, truth, envelope,
                     context.quick ? kQuickExcess_mm : problem.curve_excess_mm, checks);
    const ElastodynamicsRun fast = run("reduced", reduced);
    check_reduced(problem, "polyaffine fast", fast, truth, problem.reduced_percent, checks);
    const std::vector<DrawnRun> drawn{{name, "#1f77b4", &truth}, {"polyaffine fast", "#d62728", &fast}};
    polyaffine::write_atomically(context.out / (problem.name + ".csv"), elastodynamics_csv(problem, drawn));
    polyaffine::write_atomically(context.out / (problem.name + ".svg"),
                                 elastodynamics_svg(problem, envelope, drawn));
  }
  return checks;
}

}  // namespace cardiac
