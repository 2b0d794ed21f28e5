#include "cardiac/circulation/left_heart_loop.hpp"

#include "cardiac/circulation/outlet.hpp"

namespace cardiac {
namespace {

/// A run of samples on a circle: from `begin`, `length` samples onwards.
struct Run {
  int begin = 0, length = 0;
};

Run longest_run(const std::vector<bool>& flags) {
  const int size = static_cast<int>(flags.size());
  Run longest, current;
  for (int i = 0; i < 2 * size && longest.length < size; ++i) {
    if (!flags[i % size]) {
      current = {i + 1, 0};
    } else if (++current.length > longest.length) {
      longest = current;
    }
  }
  return longest;
}

}  // namespace

LoopFlows loop_flows(const LeftHeartLoop& loop, double pressure_kPa, double capacitor_pressure_kPa) {
  const double in = valve_flow(loop.mitral, loop.filling_pressure_kPa - pressure_kPa).flow_mm3_per_ms;
  const double out =
      valve_flow(outlet(loop.aortic, loop.arteries), pressure_kPa - capacitor_pressure_kPa).flow_mm3_per_ms;
  return {in, out, inlet_pressure(loop.arteries, capacitor_pressure_kPa, out)};
}

LoopResidual loop_residual(const LeftHeartLoop& loop, double volume_rate_mm3_per_ms, double pressure_kPa,
                           double capacitor_pressure_kPa, double capacitor_rate_kPa_per_ms) {
  const ValveFlow in = valve_flow(loop.mitral, loop.filling_pressure_kPa - pressure_kPa);
  const ValveFlow out = valve_flow(outlet(loop.aortic, loop.arteries), pressure_kPa - capacitor_pressure_kPa);
  return {
      .volume = volume_rate_mm3_per_ms - in.flow_mm3_per_ms + out.flow_mm3_per_ms,
      .capacitor = windkessel_residual(loop.arteries, capacitor_pressure_kPa, capacitor_rate_kPa_per_ms,
                                       out.flow_mm3_per_ms),
      .volume_by_pressure = in.slope + out.slope,
      .volume_by_capacitor_pressure = -out.slope,
      .capacitor_by_pressure = -out.slope,
      .capacitor_by_capacitor_pressure = out.slope + 1 / loop.arteries.peripheral_resistance_kPa_ms_per_mm3,
      .capacitor_by_capacitor_rate = loop.arteries.compliance_mm3_per_kPa,
  };
}

LoopRates loop_rates(const LeftHeartLoop& loop, double pressure_kPa, double capacitor_pressure_kPa) {
  const LoopResidual at_rest = loop_residual(loop, 0, pressure_kPa, capacitor_pressure_kPa, 0);
  return {-at_rest.volume, -at_rest.capacitor / at_rest.capacitor_by_capacitor_rate};
}

std::vector<Phase> classify_phases(const LeftHeartLoop& loop, const polyaffine::Vector& pressure_kPa,
                                   const polyaffine::Vector& capacitor_pressure_kPa) {
  return classify_phases(loop.mitral, loop.aortic,
                         polyaffine::Vector::Constant(pressure_kPa.size(), loop.filling_pressure_kPa),
                         pressure_kPa, capacitor_pressure_kPa);
}

std::vector<Phase> classify_phases(const Valve& inlet, const Valve& outlet,
                                   const polyaffine::Vector& before_kPa,
                                   const polyaffine::Vector& pressure_kPa,
                                   const polyaffine::Vector& behind_kPa) {
  const int size = static_cast<int>(pressure_kPa.size());
  std::vector<bool> outlet_open(size), inlet_closed(size);
  for (int i = 0; i < size; ++i) {
    outlet_open[i] = is_open(outlet, pressure_kPa[i] - behind_kPa[i]);
    inlet_closed[i] = !is_open(inlet, before_kPa[i] - pressure_kPa[i]);
  }

  Run ejection = longest_run(outlet_open);
  if (size > 0 && ejection.length == 0) pressure_kPa.maxCoeff(&ejection.begin);

  const auto wrap = [&](int i) { return (i + 2 * size) % size; };
  const int rest = size - ejection.length, end = ejection.begin + ejection.length;
  int before = 0, after = 0;
  while (before < rest && inlet_closed[wrap(ejection.begin - 1 - before)]) ++before;
  while (before + after < rest && inlet_closed[wrap(end + after)]) ++after;

  std::vector<Phase> phases(size, Phase::filling);
  for (int i = 0; i < ejection.length; ++i) phases[wrap(ejection.begin + i)] = Phase::ejection;
  for (int i = 1; i <= before; ++i) phases[wrap(ejection.begin - i)] = Phase::isovolumetric_contraction;
  for (int i = 0; i < after; ++i) phases[wrap(end + i)] = Phase::isovolumetric_relaxation;
  return phases;
}

}  // namespace cardiac
