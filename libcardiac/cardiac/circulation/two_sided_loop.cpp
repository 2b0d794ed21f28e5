#include "cardiac/circulation/two_sided_loop.hpp"

#include <algorithm>
#include <array>

#include "cardiac/circulation/outlet.hpp"

namespace cardiac {

using polyaffine::Matrix;
using polyaffine::Vector;

namespace {

constexpr std::array<int, 2> kArteries{systemic_arterial_pressure, pulmonary_arterial_pressure};
constexpr std::array<int, 2> kVeins{pulmonary_venous_pressure, systemic_venous_pressure};

}  // namespace

CirculationModel::Rates TwoSidedCirculation::rates(double, const Vector& z, const Vector& p) const {
  const std::array<const TwoSidedLoop::Side*, 2> sides{&loop_.left, &loop_.right};
  Rates out{Vector::Zero(two_sided_size), Matrix::Zero(two_sided_size, two_sided_size),
            Matrix::Zero(two_sided_size, 2)};
  for (int k = 0; k < 2; ++k) {
    const TwoSidedLoop::Side& side = *sides[k];
    const Windkessel& arteries = side.arteries;
    const int artery = kArteries[k], vein = kVeins[k], behind = kVeins[1 - k];
    const ValveFlow in = valve_flow(side.inlet, z[vein] - p[k]);
    const ValveFlow ejected = valve_flow(outlet(side.outlet, arteries), p[k] - z[artery]);
    const double conductance = 1 / arteries.peripheral_resistance_kPa_ms_per_mm3;
    const double run_off = conductance * (z[artery] - z[behind]);

    out.values[k] += in.flow_mm3_per_ms - ejected.flow_mm3_per_ms;
    out.by_states(k, vein) += in.slope;
    out.by_states(k, artery) += ejected.slope;
    out.by_pressures(k, k) -= in.slope + ejected.slope;

    const double C_a = arteries.compliance_mm3_per_kPa;
    out.values[artery] += (ejected.flow_mm3_per_ms - run_off) / C_a;
    out.by_states(artery, artery) -= (ejected.slope + conductance) / C_a;
    out.by_states(artery, behind) += conductance / C_a;
    out.by_pressures(artery, k) += ejected.slope / C_a;

    const double C_v = side.venous_compliance_mm3_per_kPa;
    out.values[vein] -= in.flow_mm3_per_ms / C_v;
    out.by_states(vein, vein) -= in.slope / C_v;
    out.by_pressures(vein, k) += in.slope / C_v;

    const double C_behind = sides[1 - k]->venous_compliance_mm3_per_kPa;
    out.values[behind] += run_off / C_behind;
    out.by_states(behind, artery) += conductance / C_behind;
    out.by_states(behind, behind) -= conductance / C_behind;
  }
  return out;
}

CirculationModel::Side TwoSidedCirculation::side(int cavity, double, const Vector& z, const Vector& p) const {
  const TwoSidedLoop::Side& side = of(cavity);
  const Windkessel& arteries = side.arteries;
  const double before = z[kVeins[cavity]], capacitor = z[kArteries[cavity]], behind = z[kVeins[1 - cavity]];
  const double outflow = valve_flow(outlet(side.outlet, arteries), p[cavity] - capacitor).flow_mm3_per_ms;
  const double inflow = valve_flow(side.inlet, before - p[cavity]).flow_mm3_per_ms;
  return {.before_kPa = before,
          .capacitor_kPa = capacitor,
          .artery_kPa = inlet_pressure(arteries, capacitor, outflow),
          .behind_kPa = behind,
          .inflow_mm3_per_ms = inflow,
          .outflow_mm3_per_ms = outflow,
          .run_off_mm3_per_ms = (capacitor - behind) / arteries.peripheral_resistance_kPa_ms_per_mm3,
          .inlet_mm3_per_ms = inflow,
          .outlet_mm3_per_ms = outflow};
}

Vector TwoSidedCirculation::compliances() const {
  Vector out = Vector::Zero(two_sided_size);
  for (int k = 0; k < 2; ++k) {
    out[kArteries[k]] = of(k).arteries.compliance_mm3_per_kPa;
    out[kVeins[k]] = of(k).venous_compliance_mm3_per_kPa;
  }
  return out;
}

double TwoSidedCirculation::slowest_ms() const {
  const auto time = [](const Windkessel& w) {
    return w.peripheral_resistance_kPa_ms_per_mm3 * w.compliance_mm3_per_kPa;
  };
  return std::max(time(loop_.left.arteries), time(loop_.right.arteries));
}

double TwoSidedCirculation::blood_volume(const Vector& z) const {
  return z[left_volume] + z[right_volume] + compliances().dot(z);
}

}  // namespace cardiac
