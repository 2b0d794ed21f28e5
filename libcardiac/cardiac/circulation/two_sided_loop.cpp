#include "cardiac/circulation/two_sided_loop.hpp"

#include <array>

#include "cardiac/circulation/outlet.hpp"

namespace cardiac {

using polyaffine::Matrix;
using polyaffine::Vector;

namespace {

constexpr std::array<int, 2> kArteries{systemic_arterial_pressure, pulmonary_arterial_pressure};
constexpr std::array<int, 2> kVeins{pulmonary_venous_pressure, systemic_venous_pressure};

}  // namespace

CirculationModel::Rates TwoSidedCirculation::rates(const Vector& z, const Vector& p) const {
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

double TwoSidedCirculation::blood_volume(const Vector& z) const {
  return z[left_volume] + z[right_volume] +
         loop_.left.arteries.compliance_mm3_per_kPa * z[systemic_arterial_pressure] +
         loop_.right.arteries.compliance_mm3_per_kPa * z[pulmonary_arterial_pressure] +
         loop_.left.venous_compliance_mm3_per_kPa * z[pulmonary_venous_pressure] +
         loop_.right.venous_compliance_mm3_per_kPa * z[systemic_venous_pressure];
}

}  // namespace cardiac
