#include "cardiac/circulation/closed_loop_2022.hpp"

#include <cardiac/core/units.hpp>
#include <cmath>
#include <polyaffine/core/types.hpp>

namespace cardiac {
namespace {

double flow_through_valve(const ClosedLoop& loop, double pressure_before, double pressure_behind) {
  const double drop = pressure_before - pressure_behind;
  const double opening =
      0.5 + std::atan(0.5 * polyaffine::kPi * loop.valve_sharpness_per_kPa * drop) / polyaffine::kPi;
  const double closed = std::log(loop.closed_valve_kPa_ms_per_mm3),
               open = std::log(loop.open_valve_kPa_ms_per_mm3);
  return drop / std::exp(closed + (open - closed) * opening);
}

/// mmHg/mL, seconds and mL as published.
Elastance chamber(double active, double passive, double contraction_s, double relaxation_s, double onset_s,
                  double unstressed_mL) {
  return {.active_kPa_per_mm3 = active * elastance_per_mmHg_per_mL,
          .passive_kPa_per_mm3 = passive * elastance_per_mmHg_per_mL,
          .onset_ms = onset_s * ms_per_s,
          .contraction_ms = contraction_s * ms_per_s,
          .relaxation_ms = relaxation_s * ms_per_s,
          .unstressed_volume_mm3 = unstressed_mL * mm3_per_mL};
}

/// mmHg·s/mL, mL/mmHg and mmHg·s²/mL as published.
Vessel vessel(double resistance, double compliance, double inertance) {
  return {resistance * resistance_per_mmHg_s_per_mL, compliance * compliance_per_mL_per_mmHg,
          inertance * inertance_per_mmHg_s2_per_mL};
}

}  // namespace

double chamber_pressure(const ClosedLoop& loop, const Elastance& chamber, double time_ms, double volume_mm3) {
  return elastance_at(chamber, loop.period_ms, time_ms) * (volume_mm3 - chamber.unstressed_volume_mm3);
}

ClosedLoopState closed_loop_rates(const ClosedLoop& loop, double time_ms, const ClosedLoopState& state,
                                  double lv_pressure_kPa, double rv_pressure_kPa) {
  const auto& y = state;
  const double p_la = chamber_pressure(loop, loop.la, time_ms, y[volume_la]);
  const double p_ra = chamber_pressure(loop, loop.ra, time_ms, y[volume_ra]);
  const double mitral = flow_through_valve(loop, p_la, lv_pressure_kPa);
  const double aortic = flow_through_valve(loop, lv_pressure_kPa, y[pressure_systemic_arteries]);
  const double tricuspid = flow_through_valve(loop, p_ra, rv_pressure_kPa);
  const double pulmonary = flow_through_valve(loop, rv_pressure_kPa, y[pressure_pulmonary_arteries]);

  ClosedLoopState rates;
  rates[volume_la] = y[flow_pulmonary_veins] - mitral;
  rates[volume_lv] = mitral - aortic;
  rates[volume_ra] = y[flow_systemic_veins] - tricuspid;
  rates[volume_rv] = tricuspid - pulmonary;
  const auto add_vessel = [&](const Vessel& v, int pressure, int flow, double inflow,
                              double pressure_behind) {
    rates[pressure] = (inflow - y[flow]) / v.compliance_mm3_per_kPa;
    rates[flow] =
        (y[pressure] - pressure_behind - v.resistance_kPa_ms_per_mm3 * y[flow]) / v.inertance_kPa_ms2_per_mm3;
  };
  add_vessel(loop.systemic_arteries, pressure_systemic_arteries, flow_systemic_arteries, aortic,
             y[pressure_systemic_veins]);
  add_vessel(loop.systemic_veins, pressure_systemic_veins, flow_systemic_veins, y[flow_systemic_arteries],
             p_ra);
  add_vessel(loop.pulmonary_arteries, pressure_pulmonary_arteries, flow_pulmonary_arteries, pulmonary,
             y[pressure_pulmonary_veins]);
  add_vessel(loop.pulmonary_veins, pressure_pulmonary_veins, flow_pulmonary_veins, y[flow_pulmonary_arteries],
             p_la);
  return rates;
}

double blood_volume(const ClosedLoop& loop, const ClosedLoopState& state) {
  return state[volume_la] + state[volume_lv] + state[volume_ra] + state[volume_rv] +
         loop.systemic_arteries.compliance_mm3_per_kPa * state[pressure_systemic_arteries] +
         loop.systemic_veins.compliance_mm3_per_kPa * state[pressure_systemic_veins] +
         loop.pulmonary_arteries.compliance_mm3_per_kPa * state[pressure_pulmonary_arteries] +
         loop.pulmonary_veins.compliance_mm3_per_kPa * state[pressure_pulmonary_veins];
}

ClosedLoop healthy_closed_loop() {
  return {.period_ms = 800,
          .la = chamber(0.07, 0.18, 0.17, 0.17, 0.9, 4),
          .lv = chamber(4.482, 0.17, 0.25, 0.4, 0.1, 42),
          .ra = chamber(0.06, 0.07, 0.17, 0.17, 0.9, 4),
          .rv = chamber(0.2, 0.029, 0.25, 0.4, 0.1, 16),
          .systemic_arteries = vessel(0.733, 1.372, 5e-3),
          .systemic_veins = vessel(0.32, 11.363, 5e-4),
          .pulmonary_arteries = vessel(0.046, 20, 5e-4),
          .pulmonary_veins = vessel(0.0015, 16, 5e-4),
          .open_valve_kPa_ms_per_mm3 = 0.0075 * resistance_per_mmHg_s_per_mL,
          .closed_valve_kPa_ms_per_mm3 = 75006 * resistance_per_mmHg_s_per_mL,
          .valve_sharpness_per_kPa = 200 / kPa_per_mmHg};
}

ClosedLoopState healthy_closed_loop_state() {
  ClosedLoopState state;
  state << 87.183, 118.520, 86.833, 166.177, 87.675, 35.898, 19.545, 15.004, 71.104, 94.039, 94.084, 473.279;
  state.segment<4>(volume_la) *= mm3_per_mL;
  state.segment<4>(pressure_systemic_arteries) *= kPa_per_mmHg;
  state.segment<4>(flow_systemic_arteries) *= flow_per_mL_per_s;
  return state;
}

}  // namespace cardiac
