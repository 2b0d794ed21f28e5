#include <cardiac/validation/circulation.hpp>

#include <algorithm>
#include <cmath>

#include <cardiac/circulation/closed_loop_2022.hpp>
#include <cardiac/circulation/network_circulation.hpp>
#include <cardiac/circulation/windkessel.hpp>
#include <cardiac/core/units.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/solve/ode.hpp>

namespace cardiac {
namespace {

using polyaffine::Vector;

constexpr auto kLoop = "Regazzoni et al. 2022, closed loop";

Check check_of(const std::string& method, const std::string& quantity, const std::string& unit, double value,
               double reference, double tolerance, const std::string& source) {
  return {"circulation",         method, quantity, unit, value, reference, reference - tolerance,
          reference + tolerance, source};
}

// C ṗ + (p − 1)/R = −V̇ with R = 10⁻⁴, C = 2000, V = (1 − cos(2πt/0.1))/2 + 1, p(0) = 10, a hundred
// trapezoidal steps of 0.01: p at t = 1. The residual is affine in the new pressure.
double windkessel_pressure() {
  const Windkessel w{.peripheral_resistance_kPa_ms_per_mm3 = 1e-4,
                     .compliance_mm3_per_kPa = 2000,
                     .reference_pressure_kPa = 1};
  const auto volume = [](double t) { return 0.5 * (1 - std::cos(2 * polyaffine::kPi * t / 0.1)) + 1; };
  const double dt = 0.01;
  double p = 10;
  for (int i = 0; i < 100; ++i) {
    const double inflow = -(volume((i + 1) * dt) - volume(i * dt)) / dt;
    const auto residual = [&](double next) {
      return windkessel_residual(w, (p + next) / 2, (next - p) / dt, inflow);
    };
    p = -residual(0) / (residual(1) - residual(0));
  }
  return p;
}

void closed_loop(std::vector<Check>& checks) {
  const ClosedLoop loop = healthy_closed_loop();
  const ClosedLoopState initial = healthy_closed_loop_state();
  const auto rate = [&](double t, const Vector& y, Vector& dy) {
    const ClosedLoopState state = y;
    dy = closed_loop_rates(loop, t, state, chamber_pressure(loop, loop.lv, t, y[volume_lv]),
                           chamber_pressure(loop, loop.rv, t, y[volume_rv]));
  };
  const double last = 9 * loop.period_ms, end = 10 * loop.period_ms;
  constexpr int kSamples = 801;  // of the last beat, one a millisecond
  // The largest step keeps the solver from stepping over the kinks of the elastances.
  const auto solution =
      polyaffine::solve_ode(rate, 0, initial, Vector::LinSpaced(kSamples, last, end),
                            {.relative_tolerance = 1e-8, .absolute_tolerance = 1e-7, .max_step = 5});
  if (!solution.finished()) throw polyaffine::ComputationError("closed loop: " + solution.message);
  const ClosedLoopState final = solution.states.col(kSamples - 1);
  const auto add = [&](const std::string& quantity, const std::string& unit, double value, double reference,
                       double tolerance) {
    checks.push_back(check_of("closed loop", quantity, unit, value, reference, tolerance, kLoop));
  };
  add("largest_change_after_ten_beats", "1", (final.array() / initial.array() - 1).abs().maxCoeff(), 0, 1e-3);
  add("blood_change", "1", blood_volume(loop, final) / blood_volume(loop, initial) - 1, 0, 1e-6);
  const Vector volume = solution.states.row(volume_lv).transpose() / mm3_per_mL;
  double peak = 0;
  for (int i = 0; i < kSamples; ++i)
    peak = std::max(peak, chamber_pressure(loop, loop.lv, last + i, solution.states(volume_lv, i)));
  // Half a unit of the last published digit.
  add("lv_smallest_mL", "mL", volume.minCoeff(), 66.96, 0.005);
  add("lv_largest_mL", "mL", volume.maxCoeff(), 136.74, 0.005);
  add("lv_peak_mmHg", "mmHg", peak / kPa_per_mmHg, 119.68, 0.005);
}

// The same loop as a network of compartments, whose junctions, valves and chambers are those of any other.
void network(std::vector<Check>& checks) {
  const ClosedLoop loop = healthy_closed_loop();
  const NetworkCirculation circulation(network_of(loop, healthy_closed_loop_state(), false, false),
                                       loop.period_ms);
  const Vector none(0), initial = circulation.initial_states();
  const auto rate = [&](double t, const Vector& y, Vector& dy) { dy = circulation.rates(t, y, none).values; };
  const double last = 9 * loop.period_ms, end = 10 * loop.period_ms;
  constexpr int kSamples = 801;
  const auto solution =
      polyaffine::solve_ode(rate, 0, initial, Vector::LinSpaced(kSamples, last, end),
                            {.relative_tolerance = 1e-8, .absolute_tolerance = 1e-7, .max_step = 5});
  if (!solution.finished()) throw polyaffine::ComputationError("network: " + solution.message);
  double low = INFINITY, high = 0, peak = 0;
  for (int i = 0; i < kSamples; ++i)
    for (const auto& reading : circulation.readings(last + i, solution.states.col(i), none)) {
      if (reading.name != "left_ventricle") continue;
      if (reading.quantity == CirculationModel::Quantity::pressure) {
        peak = std::max(peak, reading.value / kPa_per_mmHg);
        continue;
      }
      low = std::min(low, reading.value / mm3_per_mL);
      high = std::max(high, reading.value / mm3_per_mL);
    }
  const Vector change = solution.states.col(kSamples - 1).cwiseQuotient(initial);
  const auto add = [&](const std::string& quantity, const std::string& unit, double value, double reference,
                       double tolerance) {
    checks.push_back(check_of("network", quantity, unit, value, reference, tolerance, kLoop));
  };
  add("largest_change_after_ten_beats", "1", (change.array() - 1).abs().maxCoeff(), 0, 1e-3);
  add("lv_smallest_mL", "mL", low, 66.96, 0.005);
  add("lv_largest_mL", "mL", high, 136.74, 0.005);
  add("lv_peak_mmHg", "mmHg", peak, 119.68, 0.005);
}

}  // namespace

std::vector<Check> validate_circulation(const ValidationContext& context) {
  context.progress("windkessel and closed loop", 0);
  std::vector<Check> checks{check_of("windkessel", "pressure_at_1", "1", windkessel_pressure(),
                                     1.0608252198133676, 1e-12, "published regression value")};
  closed_loop(checks);
  network(checks);
  return checks;
}

}  // namespace cardiac
