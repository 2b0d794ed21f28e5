#pragma once

#include <limits>

#include <cardiac/core/units.hpp>

namespace cardiac {

/// A valve (or a valve in series with a resistance): a resistance one way, closed the other, without a kink.
struct Valve {
  double resistance_kPa_ms_per_mm3 = 0;
  double smoothing_kPa = 0.05 * kPa_per_mmHg;  ///< ε, the pressure over which it opens and closes
  double leak_kPa_ms_per_mm3 = std::numeric_limits<double>::infinity();  ///< resistance backwards
};

struct ValveFlow {
  double flow_mm3_per_ms;
  double slope;  ///< ∂q/∂Δp in mm³/(ms·kPa), positive
};

/// q(Δp) = s(Δp)/R − s(−Δp)/R_leak with s(x) = ε ln(1 + exp(x/ε)) and Δp the pressure before minus the
/// pressure behind the valve.
///
/// Without a leak never negative and never decreasing; Δp/R when open, 0.69 ε/R at Δp = 0, and when closed
/// below ε/R exp(−|Δp|/ε), nothing that a double holds from |Δp| = 745 ε on: an algebraic tail would let a
/// valve of tiny R leak forward. Evaluated without overflow or cancellation. R, R_leak and ε must be
/// positive.
ValveFlow valve_flow(const Valve& valve, double pressure_drop_kPa);

/// Whether a valve counts as open: Δp > −10 ε, that is a flow above 4.5e-5 ε/R. The margin keeps a valve
/// through which filling has come to rest (Δp → 0⁻) open until the pressure really turns.
bool is_open(const Valve& valve, double pressure_drop_kPa);

}  // namespace cardiac
