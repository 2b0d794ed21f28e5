#pragma once

#include <vector>

#include <cardiac/circulation/valve.hpp>
#include <cardiac/circulation/windkessel.hpp>
#include <cardiac/core/beat_result.hpp>
#include <polyaffine/core/types.hpp>

namespace cardiac {

/// A left ventricle that fills from a constant pressure through the mitral valve and ejects through the
/// aortic valve into a three-element windkessel; kPa, mm³, ms.
///
///   V̇ = q_mitral(p_fill − p) − q_aortic(p − p_c),   C ṗ_c + (p_c − p_ref)/R = q_aortic(p − p_c)
///
/// p is the cavity pressure, p_c the capacitor pressure. The proximal resistance carries the same flow as the
/// aortic valve, so both are one valve of resistance R_aortic + Z between p and p_c, and the aortic pressure
/// p_c + Z q_aortic is not an unknown. What relates V to p (a heart wall, an elastance) closes the system.
struct LeftHeartLoop {
  double filling_pressure_kPa = 0;
  Valve mitral;
  Valve aortic;  ///< the valve alone, without the proximal resistance of the arteries
  Windkessel arteries;
};

struct LoopFlows {
  double mitral_mm3_per_ms, aortic_mm3_per_ms;
  double aortic_pressure_kPa;  ///< behind the valve
};
LoopFlows loop_flows(const LeftHeartLoop& loop, double pressure_kPa, double capacitor_pressure_kPa);

/// The two equations as residuals in mm³/ms: volume = V̇ − q_mitral + q_aortic, capacitor = C ṗ_c +
/// (p_c − p_ref)/R − q_aortic, and their partial derivatives that are not zero. ∂volume/∂V̇ is 1; neither
/// depends on V.
struct LoopResidual {
  double volume, capacitor;
  double volume_by_pressure, volume_by_capacitor_pressure;
  double capacitor_by_pressure, capacitor_by_capacitor_pressure, capacitor_by_capacitor_rate;
};
LoopResidual loop_residual(const LeftHeartLoop& loop, double volume_rate_mm3_per_ms, double pressure_kPa,
                           double capacitor_pressure_kPa, double capacitor_rate_kPa_per_ms);

/// The same solved for the rates: {V̇, ṗ_c}.
struct LoopRates {
  double volume_mm3_per_ms, capacitor_pressure_kPa_per_ms;
};
LoopRates loop_rates(const LeftHeartLoop& loop, double pressure_kPa, double capacitor_pressure_kPa);

/// The phase of each sample of one whole beat, given in order of time and continued periodically.
///
/// A valve is open as is_open says. Ejection is the longest run of samples with an open aortic valve; the
/// samples before it in which the mitral valve is closed are isovolumetric contraction, those after it
/// isovolumetric relaxation, all others filling. So each phase is one run and they follow in this order
/// whatever a valve does for an instant. When the aortic valve never opens, the largest pressure parts
/// contraction from relaxation.
/// All vectors have the same size: pressures before the inlet valve, in the cavity and behind the outlet
/// valve. For the loop of a left ventricle the first is the filling pressure.
std::vector<Phase> classify_phases(const Valve& inlet, const Valve& outlet,
                                   const polyaffine::Vector& before_kPa,
                                   const polyaffine::Vector& pressure_kPa,
                                   const polyaffine::Vector& behind_kPa);
std::vector<Phase> classify_phases(const LeftHeartLoop& loop, const polyaffine::Vector& pressure_kPa,
                                   const polyaffine::Vector& capacitor_pressure_kPa);

}  // namespace cardiac
