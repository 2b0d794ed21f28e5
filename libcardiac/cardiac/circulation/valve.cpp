#include "cardiac/circulation/valve.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cardiac {
namespace {

constexpr double kOrdinaryResistance = 0.01 * resistance_per_mmHg_s_per_mL;  // R₀

// q = Δp / R(Δp) with log R between closed and open.
ValveFlow arctan_flow(const Valve& valve, double drop) {
  constexpr double pi = std::numbers::pi;
  const double x = 0.5 * pi * valve.sharpness_per_kPa * drop;
  const double closed = std::log(valve.leak_kPa_ms_per_mm3), open = std::log(valve.resistance_kPa_ms_per_mm3);
  const double resistance = std::exp(closed + (open - closed) * (0.5 + std::atan(x) / pi));
  const double log_slope = (open - closed) * 0.5 * valve.sharpness_per_kPa / (1 + x * x);
  return {drop / resistance, (1 - drop * log_slope) / resistance};
}

ValveFlow tanh_flow(const Valve& valve, double drop) {
  const double t = std::tanh(valve.sharpness_per_kPa * drop);
  const double half = 0.5 * (valve.leak_kPa_ms_per_mm3 - valve.resistance_kPa_ms_per_mm3);
  const double resistance = valve.resistance_kPa_ms_per_mm3 + half * (1 - t);
  const double slope = -half * valve.sharpness_per_kPa * (1 - t * t);
  return {drop / resistance, (1 - drop * slope / resistance) / resistance};
}

}  // namespace

ValveFlow valve_flow(const Valve& valve, double pressure_drop_kPa) {
  if (valve.law == ValveLaw::arctan) return arctan_flow(valve, pressure_drop_kPa);
  if (valve.law == ValveLaw::tanh) return tanh_flow(valve, pressure_drop_kPa);
  const double eps =
      valve.smoothing_kPa * std::sqrt(std::min(valve.resistance_kPa_ms_per_mm3 / kOrdinaryResistance, 1.0));
  const double root = std::hypot(pressure_drop_kPa, eps);
  const auto opening = [&](double drop) { return drop > 0 ? root + drop : eps * eps / (root - drop); };
  const double open = opening(pressure_drop_kPa);
  const double backward = opening(-pressure_drop_kPa) / (2 * valve.leak_kPa_ms_per_mm3);
  if (valve.stenosis_kPa_ms2_per_mm6 > 0) {
    const ValveFlow narrow =
        lossy_flow(valve.resistance_kPa_ms_per_mm3, valve.stenosis_kPa_ms2_per_mm6, open / 2);
    return {narrow.flow_mm3_per_ms - backward, (narrow.slope * open / 2 + backward) / root};
  }
  const double forward = open / (2 * valve.resistance_kPa_ms_per_mm3);
  return {forward - backward, (forward + backward) / root};
}

ValveFlow lossy_flow(double resistance, double stenosis, double drop) {
  const double root = std::sqrt(resistance * resistance + 4 * stenosis * std::abs(drop));
  return {2 * drop / (resistance + root), 1 / root};
}

ValveDrop valve_drop(const Valve& valve, double flow) {
  const double R = valve.resistance_kPa_ms_per_mm3, B = valve.stenosis_kPa_ms2_per_mm6,
               leak = valve.leak_kPa_ms_per_mm3;
  const double delta = valve.smoothing_kPa / kOrdinaryResistance * std::sqrt(std::min(R / leak, 1.0));
  const double root = std::hypot(flow, delta);
  const auto part = [&](double q) { return q > 0 ? (root + q) / 2 : delta * delta / (2 * (root - q)); };
  const double forward = part(flow), backward = part(-flow);
  return {(R + B * forward) * forward - leak * backward,
          ((R + 2 * B * forward) * forward + leak * backward) / root};
}

bool is_open(const Valve& valve, double pressure_drop_kPa) {
  return pressure_drop_kPa > -10 * valve.smoothing_kPa;
}

}  // namespace cardiac
