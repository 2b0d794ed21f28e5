#pragma once

namespace cardiac {

/// Three-element windkessel in kPa, mm³, ms: inflow q passes the proximal resistance Z to the compliance C,
/// which empties through the peripheral resistance R to p_ref. Z = 0 is the two-element windkessel.
/// Source: Westerhof, Lankhaar, Westerhof 2009.
struct Windkessel {
  double proximal_resistance_kPa_ms_per_mm3 = 0;    ///< Z ≥ 0
  double peripheral_resistance_kPa_ms_per_mm3 = 0;  ///< R > 0
  double compliance_mm3_per_kPa = 0;                ///< C > 0
  double reference_pressure_kPa = 0;                ///< p_ref, venous
};

/// C ṗ_c + (p_c − p_ref)/R − q in mm³/ms; zero when the capacitor pressure p_c obeys the windkessel. Its
/// derivatives are C by ṗ_c, 1/R by p_c and −1 by q.
inline double windkessel_residual(const Windkessel& w, double capacitor_pressure_kPa,
                                  double capacitor_rate_kPa_per_ms, double inflow_mm3_per_ms) {
  return w.compliance_mm3_per_kPa * capacitor_rate_kPa_per_ms +
         (capacitor_pressure_kPa - w.reference_pressure_kPa) / w.peripheral_resistance_kPa_ms_per_mm3 -
         inflow_mm3_per_ms;
}

/// Pressure at the inlet (the aorta), p_c + Z q in kPa.
inline double inlet_pressure(const Windkessel& w, double capacitor_pressure_kPa, double inflow_mm3_per_ms) {
  return capacitor_pressure_kPa + w.proximal_resistance_kPa_ms_per_mm3 * inflow_mm3_per_ms;
}

}  // namespace cardiac
