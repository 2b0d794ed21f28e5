#pragma once

#include <Eigen/Core>

#include <cardiac/circulation/elastance.hpp>

namespace cardiac {

/// The state of the closed loop as one vector, for a solver: volumes in mm³, pressures in kPa, flows in
/// mm³/ms.
enum ClosedLoopIndex {
  volume_la,
  volume_lv,
  volume_ra,
  volume_rv,
  pressure_systemic_arteries,
  pressure_systemic_veins,
  pressure_pulmonary_arteries,
  pressure_pulmonary_veins,
  flow_systemic_arteries,
  flow_systemic_veins,
  flow_pulmonary_arteries,
  flow_pulmonary_veins,
  closed_loop_size
};
using ClosedLoopState = Eigen::Matrix<double, closed_loop_size, 1>;

/// A vessel compartment: compliance at its inlet, then resistance and inertance; kPa, mm³, ms.
struct Vessel {
  double resistance_kPa_ms_per_mm3 = 0;
  double compliance_mm3_per_kPa = 0;
  double inertance_kPa_ms2_per_mm3 = 0;
};

/// The whole circulation: four chambers, four valves, systemic and pulmonary arteries and veins.
struct ClosedLoop {
  double period_ms = 0;
  Elastance la, lv, ra, rv;
  Vessel systemic_arteries, systemic_veins, pulmonary_arteries, pulmonary_veins;
  double open_valve_kPa_ms_per_mm3 = 0, closed_valve_kPa_ms_per_mm3 = 0;
  double valve_sharpness_per_kPa = 0;  ///< k
};

/// Rates of change of all states when the ventricles have the given pressures (a heart model's, or those of
/// their elastances), in the units of the states per ms. Per chamber V̇ = inflow − outflow, per vessel
/// C ṗ = inflow − Q and L Q̇ = p − p_next − R Q; a valve's flow is Δp / R with log R passing from closed
/// to open by ½ + arctan(½ π k Δp)/π. The blood volume Σ V + Σ C p does not change. Source: Regazzoni et al.
/// 2022.
ClosedLoopState closed_loop_rates(const ClosedLoop& loop, double time_ms, const ClosedLoopState& state,
                                  double lv_pressure_kPa, double rv_pressure_kPa);

/// E(t) (V − V₀) of a chamber in kPa.
double chamber_pressure(const ClosedLoop& loop, const Elastance& chamber, double time_ms, double volume_mm3);

/// Σ V + Σ C p in mm³.
double blood_volume(const ClosedLoop& loop, const ClosedLoopState& state);

/// A healthy adult at 75 beats a minute, and a state on its limit cycle at the begin of a period.
ClosedLoop healthy_closed_loop();
ClosedLoopState healthy_closed_loop_state();

}  // namespace cardiac
