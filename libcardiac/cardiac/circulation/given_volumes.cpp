#include "cardiac/circulation/given_volumes.hpp"

#include <algorithm>

namespace cardiac {

using polyaffine::Matrix;
using polyaffine::Vector;

namespace {
constexpr double kReturn_ms = 1;  // τ
}  // namespace

CirculationModel::Rates GivenVolumes::rates(double time_ms, const Vector& states, const Vector&) const {
  const auto n = static_cast<Eigen::Index>(curves_.size());
  Rates out{Vector(n), -Matrix::Identity(n, n) / kReturn_ms, Matrix::Zero(n, n)};
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto [volume, rate] = curves_[static_cast<std::size_t>(k)].at(time_ms);
    out.values[k] = rate + (volume - states[k]) / kReturn_ms;
  }
  return out;
}

CirculationModel::Side GivenVolumes::side(int cavity, double time_ms, const Vector& states,
                                          const Vector& pressures_kPa) const {
  const double flow = rates(time_ms, states, pressures_kPa).values[cavity], p = pressures_kPa[cavity];
  Side out{};
  out.before_kPa = out.capacitor_kPa = out.artery_kPa = out.behind_kPa = p;
  out.inflow_mm3_per_ms = out.inlet_mm3_per_ms = std::max(flow, 0.0);
  out.outflow_mm3_per_ms = out.outlet_mm3_per_ms = out.run_off_mm3_per_ms = std::max(-flow, 0.0);
  return out;
}

}  // namespace cardiac
