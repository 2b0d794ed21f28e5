#include <algorithm>
#include <utility>

#include "cardiac/circulation/network_circulation.hpp"

// What a network tells of itself: sides of the cavities, readings, balances, where it begins.
namespace cardiac {

using polyaffine::Vector;

CirculationModel::Side NetworkCirculation::side(int cavity, double time_ms, const Vector& z,
                                                const Vector& p) const {
  const Picture at = picture(time_ms, z, p);
  const auto c = static_cast<std::size_t>(cavity);
  const int ventricle = cavities_[c], inlet = inlets_[c], outlet = outlets_[c];
  const int behind = links_[static_cast<std::size_t>(outlet)].to;
  Side out{};
  out.before_kPa = at.pressures[links_[static_cast<std::size_t>(inlet)].from];
  out.inlet_mm3_per_ms = at.flows[inlet];
  out.outlet_mm3_per_ms = at.flows[outlet];
  out.capacitor_kPa = out.behind_kPa = at.pressures[behind];
  out.artery_kPa = out.capacitor_kPa + element_of(outlets_, cavity).series_kPa_ms_per_mm3 * at.flows[outlet];
  for (std::size_t l = 0; l < links_.size(); ++l) {
    const double q = at.flows[static_cast<Eigen::Index>(l)];
    if (links_[l].to == ventricle) out.inflow_mm3_per_ms += q;
    if (links_[l].from == ventricle) out.outflow_mm3_per_ms += q;
    if (links_[l].from != behind) continue;
    out.run_off_mm3_per_ms += q;
    out.behind_kPa = at.pressures[links_[l].to];
  }
  return out;
}

CirculationModel::Names NetworkCirculation::names(int cavity) const {
  const Element &in = element_of(inlets_, cavity), &out = element_of(outlets_, cavity);
  const auto node = static_cast<std::size_t>(cavities_[static_cast<std::size_t>(cavity)]);
  return {in.from,
          network_.compartments[node].name,
          out.between.empty() ? out.to : out.between,
          out.to,
          in.name,
          out.name,
          ""};
}

Vector NetworkCirculation::compliances() const {
  Vector out = Vector::Zero(num_states_);
  for (std::size_t n = 0; n < nodes_.size(); ++n)
    if (network_.compartments[n].type == CompartmentType::vessel)
      out[nodes_[n].state] = network_.compartments[n].compliance_mm3_per_kPa;
  return out;
}

bool NetworkCirculation::is_closed() const {
  return std::ranges::none_of(network_.compartments,
                              [](const Compartment& c) { return c.type == CompartmentType::pressure; });
}

double NetworkCirculation::slowest_ms() const {
  double slowest = 0;
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    if (network_.compartments[n].type != CompartmentType::vessel) continue;
    double conductance = 0;
    for (std::size_t l = 0; l < links_.size(); ++l) {
      const bool joins = links_[l].from == static_cast<int>(n) || links_[l].to == static_cast<int>(n);
      const double R = links_[l].valve.resistance_kPa_ms_per_mm3;
      if (joins && R > 0 && network_.elements[l].type == ElementType::resistance) conductance += 1 / R;
    }
    if (conductance > 0)
      slowest = std::max(slowest, network_.compartments[n].compliance_mm3_per_kPa / conductance);
  }
  return slowest;
}

std::vector<CirculationModel::Reading> NetworkCirculation::readings(double time_ms, const Vector& z,
                                                                    const Vector& p) const {
  const Picture at = picture(time_ms, z, p);
  std::vector<Reading> out;
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const Compartment& compartment = network_.compartments[n];
    out.push_back({compartment.name, Quantity::pressure, at.pressures[static_cast<Eigen::Index>(n)]});
    if (nodes_[n].cavity >= 0) out.push_back({compartment.name, Quantity::volume, z[nodes_[n].cavity]});
    if (compartment.type == CompartmentType::chamber)
      out.push_back({compartment.name, Quantity::volume, z[nodes_[n].state]});
  }
  for (std::size_t l = 0; l < links_.size(); ++l) {
    const Element& element = network_.elements[l];
    const double q = at.flows[static_cast<Eigen::Index>(l)];
    out.push_back({element.name, Quantity::flow, q});
    if (!element.between.empty())
      out.push_back({element.between, Quantity::pressure,
                     at.pressures[links_[l].to] + element.series_kPa_ms_per_mm3 * q});
  }
  return out;
}

std::vector<CirculationModel::Balance> NetworkCirculation::balances(double time_ms, const Vector& z,
                                                                    const Vector& p) const {
  const Picture at = picture(time_ms, z, p);
  std::vector<Balance> out;
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    if (network_.compartments[n].type != CompartmentType::vessel) continue;
    Balance balance{network_.compartments[n].name, 0, 0};
    for (std::size_t l = 0; l < links_.size(); ++l) {
      const double q = at.flows[static_cast<Eigen::Index>(l)];
      if (links_[l].to == static_cast<int>(n)) balance.inflow_mm3_per_ms += q;
      if (links_[l].from == static_cast<int>(n)) balance.outflow_mm3_per_ms += q;
    }
    out.push_back(std::move(balance));
  }
  return out;
}

Vector NetworkCirculation::filling_pressures() const {
  Vector out(num_cavities_);
  for (int k = 0; k < num_cavities_; ++k)
    out[k] =
        network_.compartments[static_cast<std::size_t>(cavities_[static_cast<std::size_t>(k)])].pressure_kPa;
  return out;
}

Vector NetworkCirculation::initial_states() const {
  Vector out = Vector::Zero(num_states_ - num_cavities_);
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const Compartment& compartment = network_.compartments[n];
    if (nodes_[n].state >= 0)
      out[nodes_[n].state - num_cavities_] = compartment.type == CompartmentType::vessel
                                                 ? compartment.pressure_kPa
                                                 : compartment.initial_volume_mm3;
  }
  for (std::size_t l = 0; l < links_.size(); ++l)
    if (links_[l].state >= 0)
      out[links_[l].state - num_cavities_] = network_.elements[l].initial_flow_mm3_per_ms;
  return out;
}

}  // namespace cardiac
