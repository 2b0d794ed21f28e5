#pragma once

#include <limits>

#include <cardiac/core/units.hpp>

namespace cardiac {

/// A valve (or a valve in series with a resistance): a resistance one way, closed the other, without a kink.
struct Valve {
  double resistance_kPa_ms_per_mm3 = 0;
  double smoothing_kPa = 0.05 * kPa_per_mmHg;  ///< ε, the pressure over which it opens and closes from R₀ on
  double leak_kPa_ms_per_mm3 = std::numeric_limits<double>::infinity();  ///< resistance backwards
};

struct ValveFlow {
  double flow_mm3_per_ms;
  double slope;  ///< ∂q/∂Δp in mm³/(ms·kPa), positive
};

/// q(Δp) = (√(Δp² + ε²) + Δp) / (2R) − (√(Δp² + ε²) − Δp) / (2R_leak), with Δp the pressure before minus the
/// pressure behind the valve.
///
/// Without a leak always positive and increasing; Δp/R when open, ε/(2R) at Δp = 0, and ε²/(4R|Δp|) when
/// closed: with ε 0.05 mmHg and R 0.01 mmHg·s/mL a closed valve under 100 mmHg leaks 0.0006 mL/s, forward.
/// Below that resistance R₀ it is ε√(R/R₀), so that no valve leaks more than that. Evaluated without
/// cancellation on both sides. R, R_leak and ε must be positive.
ValveFlow valve_flow(const Valve& valve, double pressure_drop_kPa);

/// Whether a valve counts as open: Δp > −10 ε, that is a flow above ε/(40 max(R, R₀)). The margin keeps a
/// valve through which filling has come to rest (Δp → 0⁻) open until the pressure really turns.
bool is_open(const Valve& valve, double pressure_drop_kPa);

}  // namespace cardiac
