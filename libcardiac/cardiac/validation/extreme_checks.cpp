#include "cardiac/validation/extreme_checks.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <exception>
#include <limits>
#include <map>
#include <sstream>
#include <thread>

#include <cardiac/core/units.hpp>
#include <cardiac/protocol/build_anatomy.hpp>
#include <cardiac/run/build_ventricle.hpp>
#include <polyaffine/core/error.hpp>

namespace cardiac {
namespace {

constexpr double kLongest = 120;  // s

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

bool finite(const HeartPath& path) {
  return std::ranges::all_of(path.steps, [](const HeartState& s) {
    return s.c.allFinite() && s.volumes_mm3.allFinite() && s.pressures_kPa.allFinite() &&
           s.vessels_kPa.allFinite();
  });
}

int smallest_region(const std::vector<int>& region_of_tet) {
  std::map<int, int> tets;
  for (const int region : region_of_tet) ++tets[region];
  const auto least = std::ranges::min_element(tets, {}, [](const auto& one) { return one.second; });
  return least == tets.end() ? 0 : least->second;
}

CheckRecord record_of(const ExtremeOutcome& outcome) {
  const HeartPath& path = outcome.path;
  const long cuts = path.cuts + path.cost.error_test_failures + path.cost.convergence_failures;
  return {path.time_steps,
          path.newton_iterations,
          static_cast<int>(cuts),
          path.simulated_ms,
          outcome.completed(),
          outcome.completed() ? "completed"
          : outcome.finite    ? outcome.reason
                              : "a number that is none in the results",
          path.warnings};
}

Check check_of(const ExtremeOutcome& outcome, const std::string& quantity, const std::string& unit,
               double value, const ExtremeBound& bound) {
  Check out{"extreme/" + outcome.scene,
            outcome.method,
            quantity,
            unit,
            value,
            bound.reference,
            bound.low,
            bound.high,
            bound.source,
            outcome.wall_s};
  out.record = record_of(outcome);
  return out;
}

}  // namespace

double ExtremeOutcome::cavity_ratio() const {
  return path.steps.empty() ? 1 : path.steps.back().volumes_mm3[0] / cavity_at_rest_mm3;
}

double ExtremeOutcome::smallest_ratio() const {
  double smallest = std::numeric_limits<double>::infinity();
  for (const HeartState& s : path.steps) smallest = std::min(smallest, s.volumes_mm3[0] / cavity_at_rest_mm3);
  return smallest;
}

double ExtremeOutcome::ef_percent() const {
  double low = std::numeric_limits<double>::infinity(), high = 0;
  for (const HeartState& s : path.steps) {
    low = std::min(low, s.volumes_mm3[0]);
    high = std::max(high, s.volumes_mm3[0]);
  }
  return 100 * (high - low) / high;
}

double ExtremeOutcome::peak_pressure_mmHg() const {
  double peak = -std::numeric_limits<double>::infinity();
  for (const HeartState& s : path.steps) peak = std::max(peak, s.pressures_kPa[0]);
  return peak / kPa_per_mmHg;
}

const char* const kNoEquilibrium = "% of the load: no equilibrium was found beyond it";

const char* const kExtremePassive = R"(
[mesh]
shape = "human_lv"
[tissue]
law = "neo_hookean"
[cavities]
pressure_mmHg = 7.5
)";

const char* const kExtremeBeat = R"(
[mesh]
shape = "human_lv"
[tissue]
law = "guccione"
C_kPa = 2.0
bf = 8.0
bt = 2.0
bfs = 20.0
[fibres]
endo_angle_deg = 70.0
epi_angle_deg = -70.0
[activation]
onset_ms = 100.0
[contraction]
contractility_kPa = 155.0
cross_fibre_fraction = 0.3
[circulation]
compliance_mL_per_mmHg = 1.3
initial_aortic_pressure_mmHg = 75.0
[time]
max_beats = 1
)";

void side_by_side(std::size_t count, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next = 0;
  std::vector<std::exception_ptr> failed(count);
  const auto take = [&] {
    for (std::size_t k = next++; k < count; k = next++) try {
        work(k);
      } catch (...) {
        failed[k] = std::current_exception();
      }
  };
  {
    std::vector<std::jthread> workers(std::max(1U, std::thread::hardware_concurrency()));
    for (std::jthread& worker : workers) worker = std::jthread(take);
  }
  for (const std::exception_ptr& one : failed)
    if (one) std::rethrow_exception(one);
}

std::string as_text(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

std::vector<std::string> full_order(std::vector<std::string> settings) {
  settings.insert(settings.begin(), "reduction.method=fem");
  return settings;
}

ExtremeMesh extreme_mesh(const StructuredCells& cells) {
  CurvedMesh made = structured_ellipsoid(human_lv(), cells);
  return {std::move(made.mesh), std::move(made.midpoints)};
}

ExtremeChecks::ExtremeChecks(const ValidationContext& context)
    : context_(context), wall_(extreme_mesh({6, 12, 1})), coarse_wall_(extreme_mesh({4, 8, 1})) {}

ExtremeOutcome ExtremeChecks::run(const std::string& scene, const ExtremeMesh& mesh,
                                  const std::string& protocol,
                                  const std::vector<std::string>& settings) const {
  const auto start = std::chrono::steady_clock::now();
  ExtremeOutcome out;
  out.scene = scene;
  RunControl control;
  control.stop_reason = [&] {
    out.told = seconds_since(start) <= kLongest;
    return out.told ? std::string() : std::string("more than two minutes");
  };
  try {
    const Protocol read = parse_protocol(protocol, "extreme/" + scene, settings);
    const bool fem = read.reduction.method == protocol::Method::fem;
    out.method = (fem ? "fem_p" + std::to_string(read.reduction.element_order) : std::string("polyaffine")) +
                 " " + std::to_string(mesh.mesh.num_tets()) + " tets";
    const auto anatomy = std::make_shared<const Anatomy>(
        build_anatomy(mesh.mesh, read, {.midpoints = mesh.midpoints, .fibres = {}}));
    const Ventricle ventricle = build_ventricle(anatomy, read, read.reduction.method);
    out.smallest_region_tets = smallest_region(ventricle.discretisation.region);
    out.cavity_at_rest_mm3 =
        ventricle.cavities.empty()
            ? 0
            : ventricle.cavity_volume(polyaffine::Vector::Zero(ventricle.num_coefficients()));
    out.path =
        read.circulation ? run_beats(ventricle, read, control) : run_prescribed(ventricle, read, control);
    out.reason = out.path.stop_reason;
    out.finite = finite(out.path);
  } catch (const polyaffine::InputError& error) {
    out.reason = error.what();
  } catch (const polyaffine::ComputationError& error) {
    out.reason = error.what();
  } catch (const std::exception& error) {
    out.reason = std::string("unforeseen: ") + error.what();
    out.told = false;
  }
  out.wall_s = seconds_since(start);
  context_.progress("extreme/" + scene, 0.5);
  return out;
}

void ExtremeChecks::expect(const ExtremeOutcome& outcome, const std::string& quantity,
                           const std::string& unit, double value, const ExtremeBound& bound) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  add(check_of(outcome, quantity, unit, outcome.completed() ? value : none, bound));
}

void ExtremeChecks::expect_inflation_of(const ExtremeOutcome& outcome, const ExtremeOutcome& reference,
                                        double percent, const std::string& source) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const double expected = reference.completed() ? reference.inflation() : none, part = percent / 100;
  expect(outcome, "inflation", "1", outcome.inflation(),
         {expected, expected * (1 - part), expected * (1 + part), source});
}

void ExtremeChecks::expect_or_stop(const ExtremeOutcome& outcome, const std::string& quantity,
                                   const std::string& unit, double value, const ExtremeBound& bound,
                                   const std::string& words) {
  if (outcome.completed()) return expect(outcome, quantity, unit, value, bound);
  expect_refusal(outcome, words);
}

void ExtremeChecks::expect_refusal(const ExtremeOutcome& outcome, const std::string& words) {
  const bool told = !outcome.reason.empty() && outcome.told && outcome.finite &&
                    outcome.reason.find(words) != std::string::npos;
  add(check_of(
      outcome, "stopped_with_reason", "1", told ? 1 : 0,
      {1, 1, 1, words.empty() ? "a reason, and finite states" : "a reason that says \"" + words + "\""}));
}

}  // namespace cardiac
