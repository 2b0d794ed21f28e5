#pragma once

#include <limits>

#include <cardiac/core/units.hpp>

namespace cardiac {

/// How the flow of a valve follows from the pressure drop.
enum class ValveLaw {
  smooth,  ///< a resistance one way, another the other, joined without a kink (valve_flow)
  arctan,  ///< log R passes from closed to open by ½ + arctan(½ π k Δp)/π (Regazzoni et al. 2022)
  tanh     ///< R passes from closed to open by ½ (1 + tanh(k Δp)) (Pfaller et al. 2019)
};

/// A valve (or a valve in series with a resistance): a resistance one way, closed the other, without a kink.
struct Valve {
  double resistance_kPa_ms_per_mm3 = 0;
  double smoothing_kPa = 0.05 * kPa_per_mmHg;  ///< ε, the pressure over which it opens and closes from R₀ on
  double leak_kPa_ms_per_mm3 = std::numeric_limits<double>::infinity();  ///< resistance backwards
  double stenosis_kPa_ms2_per_mm6 = 0;  ///< B of a forward loss R q + B q² (Bernoulli); smooth law only
  ValveLaw law = ValveLaw::smooth;
  double sharpness_per_kPa = 0;  ///< k of the other laws, whose leak is the closed valve
};

struct ValveFlow {
  double flow_mm3_per_ms;
  double slope;  ///< ∂q/∂Δp in mm³/(ms·kPa); positive but for a closed arctan valve
};

/// Of the smooth law, with Δp the pressure before minus the pressure behind the valve,
///   q(Δp) = (√(Δp² + ε²) + Δp) / (2R) − (√(Δp² + ε²) − Δp) / (2R_leak);
/// with a stenosis the forward part q₊ obeys R q₊ + B q₊² = (√(Δp² + ε²) + Δp)/2.
///
/// Without a leak always positive and increasing; Δp/R when open, ε/(2R) at Δp = 0, and ε²/(4R|Δp|) when
/// closed: with ε 0.05 mmHg and R 0.01 mmHg·s/mL a closed valve under 100 mmHg leaks 0.0006 mL/s, forward.
/// Below that resistance R₀ it is ε√(R/R₀), so that no valve leaks more than that. Evaluated without
/// cancellation on both sides. R, R_leak and ε must be positive. The other laws: q = Δp / R(Δp).
ValveFlow valve_flow(const Valve& valve, double pressure_drop_kPa);

/// A resistance with a loss that grows with the square of the flow, the same both ways: R q + B q|q| = Δp.
/// R must be positive, B not negative.
ValveFlow lossy_flow(double resistance_kPa_ms_per_mm3, double stenosis_kPa_ms2_per_mm6,
                     double pressure_drop_kPa);

/// The pressure drop Δp(q) over a valve that a flow q comes through, for a valve with inertance, whose flow
/// is a state: R q₊ + B q₊² − R_leak q₋ with q± = ½ (√(q² + δ²) ± q), and its slope ∂Δp/∂q. δ is the flow
/// that ε makes in the resistance R₀ times √(R/R_leak), so that the closed side's resistance plays no part
/// when open. R_leak must be finite.
struct ValveDrop {
  double drop_kPa, slope;
};
ValveDrop valve_drop(const Valve& valve, double flow_mm3_per_ms);

/// Whether a valve counts as open: Δp > −10 ε, that is a flow above ε/(40 max(R, R₀)). The margin keeps a
/// valve through which filling has come to rest (Δp → 0⁻) open until the pressure really turns.
bool is_open(const Valve& valve, double pressure_drop_kPa);

}  // namespace cardiac
