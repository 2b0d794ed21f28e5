#include "cardiac/circulation/network_circulation.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "cardiac/circulation/outlet.hpp"

namespace cardiac {

using polyaffine::Matrix;
using polyaffine::Vector;

namespace {

constexpr int kMostIterations = 200, kMostHalvings = 60;
constexpr double kRounding = 1e-14;  // of the flows through a junction, relative
constexpr double kFlatter = 0.9;     // what a step must leave of the slope along it

Valve valve_of(const Element& element) {
  if (element.type != ElementType::valve || element.series_kPa_ms_per_mm3 == 0) return element.valve;
  return outlet(element.valve, {.proximal_resistance_kPa_ms_per_mm3 = element.series_kPa_ms_per_mm3});
}

}  // namespace

NetworkCirculation::NetworkCirculation(CirculationNetwork network, double beat_ms)
    : network_(std::move(network)), period_ms_(network_.period_ms > 0 ? network_.period_ms : beat_ms) {
  if (const auto fault = fault_of(network_)) throw std::invalid_argument("network: " + fault->text);
  const auto& compartments = network_.compartments;
  nodes_.resize(compartments.size());
  const auto each = [&](CompartmentType type, auto&& act) {
    for (std::size_t n = 0; n < compartments.size(); ++n)
      if (compartments[n].type == type) act(n);
  };
  for (const CavityName wanted : {CavityName::lv, CavityName::rv})
    each(CompartmentType::ventricle, [&](std::size_t n) {
      if (compartments[n].cavity != wanted) return;
      nodes_[n].cavity = num_cavities_++;
      cavities_.push_back(static_cast<int>(n));
    });
  num_states_ = num_cavities_;
  each(CompartmentType::vessel, [&](std::size_t n) {
    nodes_[n].state = num_states_++;
    ++kinds_.pressures;
  });
  each(CompartmentType::chamber, [&](std::size_t n) {
    nodes_[n].state = num_states_++;
    ++kinds_.volumes;
  });
  each(CompartmentType::junction, [&](std::size_t n) {
    nodes_[n].junction = static_cast<int>(junctions_.size());
    junctions_.push_back(static_cast<int>(n));
  });
  const auto node_of = [&](const std::string& name) {
    const auto found = std::ranges::find(compartments, name, &Compartment::name);
    return static_cast<int>(found - compartments.begin());
  };
  for (const Element& element : network_.elements) {
    Link link{node_of(element.from), node_of(element.to), -1, valve_of(element)};
    if (element.inertance_kPa_ms2_per_mm3 > 0 && !element.curve) {
      link.state = num_states_++;
      ++kinds_.flows;
    }
    links_.push_back(link);
  }
  for (const int ventricle : cavities_) {
    inlets_.push_back(valve_at(ventricle, &Link::to, &Link::from));
    outlets_.push_back(valve_at(ventricle, &Link::from, &Link::to));
  }
}

int NetworkCirculation::valve_at(int node, int Link::*near, int Link::*far) const {
  for (std::size_t l = 0; l < links_.size(); ++l)
    if (links_[l].*near == node && network_.elements[l].type == ElementType::valve)
      return static_cast<int>(l);
  for (const Link& link : links_) {
    if (link.*near != node || nodes_[static_cast<std::size_t>(link.*far)].junction < 0) continue;
    if (const int beyond = valve_at(link.*far, near, far); beyond >= 0) return beyond;
  }
  return -1;
}

void NetworkCirculation::flow_through(std::size_t l, Picture& at) const {
  const Link& link = links_[l];
  const Element& element = network_.elements[l];
  const auto k = static_cast<Eigen::Index>(l);
  if (link.state >= 0 || element.curve) return;
  const double drop = at.pressures[link.from] - at.pressures[link.to];
  const ValveFlow flow = element.type == ElementType::valve
                             ? valve_flow(link.valve, drop)
                             : lossy_flow(link.valve.resistance_kPa_ms_per_mm3,
                                          link.valve.stenosis_kPa_ms2_per_mm6, drop + element.head_kPa);
  at.flows[k] = flow.flow_mm3_per_ms;
  at.slopes[k] = flow.slope;
}

Vector NetworkCirculation::net_inflow(const Vector& flows) const {
  Vector out = Vector::Zero(static_cast<Eigen::Index>(nodes_.size()));
  for (std::size_t l = 0; l < links_.size(); ++l) {
    const double q = flows[static_cast<Eigen::Index>(l)];
    out[links_[l].to] += q;
    out[links_[l].from] -= q;
  }
  return out;
}

NetworkCirculation::Picture NetworkCirculation::picture(double time_ms, const Vector& z,
                                                        const Vector& p) const {
  const auto n = static_cast<Eigen::Index>(nodes_.size()), m = static_cast<Eigen::Index>(links_.size());
  Picture at{Vector::Zero(n), Vector::Zero(m), Vector::Zero(m), Vector::Zero(n)};
  const double t = time_ms - period_ms_ * std::floor(time_ms / period_ms_);
  for (Eigen::Index k = 0; k < n; ++k) {
    const Node& node = nodes_[static_cast<std::size_t>(k)];
    const Compartment& compartment = network_.compartments[static_cast<std::size_t>(k)];
    at.stiffness[k] = 1;
    if (node.cavity >= 0) {
      at.pressures[k] = p[node.cavity];
    } else if (compartment.type == CompartmentType::vessel) {
      at.pressures[k] = z[node.state];
    } else if (compartment.type == CompartmentType::chamber) {
      const ChamberPressure in = pressure_in(compartment.chamber, period_ms_, t, z[node.state]);
      at.pressures[k] = in.pressure_kPa;
      at.stiffness[k] = in.stiffness;
    } else if (compartment.type == CompartmentType::pressure) {
      at.pressures[k] = compartment.curve ? compartment.curve->at(t) : compartment.pressure_kPa;
    }
  }
  for (std::size_t l = 0; l < links_.size(); ++l) {
    const auto k = static_cast<Eigen::Index>(l);
    if (links_[l].state >= 0) at.flows[k] = z[links_[l].state];
    if (const auto& curve = network_.elements[l].curve) at.flows[k] = curve->at(t);
  }
  if (!junctions_.empty()) solve_junctions(at);
  for (std::size_t l = 0; l < links_.size(); ++l) flow_through(l, at);
  return at;
}

void NetworkCirculation::solve_junctions(Picture& at) const {
  const auto count = static_cast<Eigen::Index>(junctions_.size());
  double sum = 0;
  int known = 0;
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    if (nodes_[n].junction >= 0) continue;
    sum += at.pressures[static_cast<Eigen::Index>(n)];
    ++known;
  }
  for (const int n : junctions_) at.pressures[n] = known > 0 ? sum / known : 0;
  const auto excess = [&] {  // into each junction
    for (std::size_t l = 0; l < links_.size(); ++l) flow_through(l, at);
    const Vector all = net_inflow(at.flows);
    Vector out(count);
    for (Eigen::Index j = 0; j < count; ++j) out[j] = all[junctions_[static_cast<std::size_t>(j)]];
    return out;
  };
  Vector F = excess();
  for (int k = 0; k < kMostIterations && F.cwiseAbs().maxCoeff() > kRounding * at.flows.cwiseAbs().sum();
       ++k) {
    Matrix conductance = Matrix::Zero(count, count);
    for (std::size_t l = 0; l < links_.size(); ++l) {
      const int a = nodes_[static_cast<std::size_t>(links_[l].from)].junction,
                b = nodes_[static_cast<std::size_t>(links_[l].to)].junction;
      const double slope = at.slopes[static_cast<Eigen::Index>(l)];
      if (a >= 0) conductance(a, a) += slope;
      if (b >= 0) conductance(b, b) += slope;
      if (a >= 0 && b >= 0) {
        conductance(a, b) -= slope;
        conductance(b, a) -= slope;
      }
    }
    const Vector step = conductance.partialPivLu().solve(F);
    const double slope = F.dot(step);
    if (!step.allFinite() || !(slope > 0)) return;
    Vector from(count);
    for (Eigen::Index j = 0; j < count; ++j) from[j] = at.pressures[junctions_[static_cast<std::size_t>(j)]];
    double part = 1;
    for (int halving = 0; halving < kMostHalvings; ++halving, part /= 2) {
      for (Eigen::Index j = 0; j < count; ++j)
        at.pressures[junctions_[static_cast<std::size_t>(j)]] = from[j] + part * step[j];
      F = excess();
      if (std::abs(F.dot(step)) <= kFlatter * slope) break;
    }
    const double size = from.cwiseAbs().maxCoeff() + step.cwiseAbs().maxCoeff();
    if (part * step.cwiseAbs().maxCoeff() <= std::numeric_limits<double>::epsilon() * size) return;
  }
}

CirculationModel::Rates NetworkCirculation::rates(double time_ms, const Vector& z, const Vector& p) const {
  const Picture at = picture(time_ms, z, p);
  const Eigen::Index inputs = num_states_ + num_cavities_;
  // By the inputs: the states, then the pressures of the cavities.
  Matrix pressure_by = Matrix::Zero(at.pressures.size(), inputs);
  for (Eigen::Index n = 0; n < at.pressures.size(); ++n) {
    const Node& node = nodes_[static_cast<std::size_t>(n)];
    if (node.cavity >= 0) pressure_by(n, num_states_ + node.cavity) = 1;
    if (node.state >= 0) pressure_by(n, node.state) = at.stiffness[n];
  }
  const auto flows_by = [&] {
    Matrix out = Matrix::Zero(at.flows.size(), inputs);
    for (std::size_t l = 0; l < links_.size(); ++l) {
      const auto k = static_cast<Eigen::Index>(l);
      const Link& link = links_[l];
      if (link.state >= 0)
        out(k, link.state) = 1;
      else if (at.slopes[k] != 0)
        out.row(k) = at.slopes[k] * (pressure_by.row(link.from) - pressure_by.row(link.to));
    }
    return out;
  };
  Matrix flow_by = flows_by();
  if (!junctions_.empty()) {
    const auto count = static_cast<Eigen::Index>(junctions_.size());
    Matrix conductance = Matrix::Zero(count, count), inflow_by = Matrix::Zero(count, inputs);
    for (std::size_t l = 0; l < links_.size(); ++l) {
      const auto k = static_cast<Eigen::Index>(l);
      const int a = nodes_[static_cast<std::size_t>(links_[l].from)].junction,
                b = nodes_[static_cast<std::size_t>(links_[l].to)].junction;
      if (a >= 0) conductance(a, a) += at.slopes[k];
      if (b >= 0) conductance(b, b) += at.slopes[k];
      if (a >= 0 && b >= 0) {
        conductance(a, b) -= at.slopes[k];
        conductance(b, a) -= at.slopes[k];
      }
      if (a >= 0) inflow_by.row(a) -= flow_by.row(k);
      if (b >= 0) inflow_by.row(b) += flow_by.row(k);
    }
    const Matrix junction_by = conductance.partialPivLu().solve(inflow_by);
    for (Eigen::Index j = 0; j < count; ++j)
      pressure_by.row(junctions_[static_cast<std::size_t>(j)]) = junction_by.row(j);
    flow_by = flows_by();
  }

  Vector values = Vector::Zero(num_states_);
  Matrix by = Matrix::Zero(num_states_, inputs);
  const Vector inflow = net_inflow(at.flows);
  std::vector<int> state_of(nodes_.size(), -1);
  std::vector<double> capacity(nodes_.size(), 1);
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    state_of[n] = nodes_[n].cavity >= 0 ? nodes_[n].cavity : nodes_[n].state;
    if (network_.compartments[n].type == CompartmentType::vessel)
      capacity[n] = network_.compartments[n].compliance_mm3_per_kPa;
    if (state_of[n] >= 0) values[state_of[n]] = inflow[static_cast<Eigen::Index>(n)] / capacity[n];
  }
  for (std::size_t l = 0; l < links_.size(); ++l) {
    const auto k = static_cast<Eigen::Index>(l);
    const Link& link = links_[l];
    const auto from = static_cast<std::size_t>(link.from), to = static_cast<std::size_t>(link.to);
    if (state_of[to] >= 0) by.row(state_of[to]) += flow_by.row(k) / capacity[to];
    if (state_of[from] >= 0) by.row(state_of[from]) -= flow_by.row(k) / capacity[from];
    if (link.state < 0) continue;
    const Element& element = network_.elements[l];
    const double L = element.inertance_kPa_ms2_per_mm3, q = at.flows[k];
    ValveDrop loss{};
    if (element.type == ElementType::valve) {
      loss = valve_drop(link.valve, q);
    } else {
      const double R = link.valve.resistance_kPa_ms_per_mm3, B = link.valve.stenosis_kPa_ms2_per_mm6;
      loss = {(R + B * std::abs(q)) * q, R + 2 * B * std::abs(q)};
    }
    values[link.state] =
        (at.pressures[link.from] - at.pressures[link.to] + element.head_kPa - loss.drop_kPa) / L;
    by.row(link.state) += (pressure_by.row(link.from) - pressure_by.row(link.to)) / L;
    by(link.state, link.state) -= loss.slope / L;
  }
  return {std::move(values), by.leftCols(num_states_), by.rightCols(num_cavities_)};
}

}  // namespace cardiac
