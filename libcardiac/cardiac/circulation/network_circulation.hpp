#pragma once

#include <cardiac/circulation/circulation_model.hpp>
#include <cardiac/circulation/network.hpp>

namespace cardiac {

/// A network as the circulation of a heart, or alone. States: volumes of the cavities (left, right), then the
/// vessels' pressures, the chambers' volumes and the flows of inertances, each in the order of the network;
///   C ṗ = Σ q_in − Σ q_out,  V̇ = Σ q_in − Σ q_out,  L q̇ = Δp + head − drop(q).
/// The pressures of junctions are no states: at every evaluation they are those for which Σ q_in = Σ q_out,
/// found by Newton's method on a function that is convex since flows grow with pressure drops.
class NetworkCirculation : public CirculationModel {
 public:
  /// Throws std::invalid_argument for a network with a fault (fault_of). `beat_ms` is the period of networks
  /// that have none.
  NetworkCirculation(CirculationNetwork network, double beat_ms);

  int num_cavities() const override { return num_cavities_; }
  int num_states() const override { return num_states_; }
  Kinds kinds() const override { return kinds_; }
  Rates rates(double time_ms, const polyaffine::Vector& states,
              const polyaffine::Vector& pressures_kPa) const override;
  Side side(int cavity, double time_ms, const polyaffine::Vector& states,
            const polyaffine::Vector& pressures_kPa) const override;
  Names names(int cavity) const override;
  const Valve& inlet(int cavity) const override { return element_of(inlets_, cavity).valve; }
  const Valve& outlet_valve(int cavity) const override { return element_of(outlets_, cavity).valve; }
  polyaffine::Vector compliances() const override;
  bool is_closed() const override;
  double slowest_ms() const override;
  std::vector<Reading> readings(double time_ms, const polyaffine::Vector& states,
                                const polyaffine::Vector& pressures_kPa) const override;
  std::vector<Balance> balances(double time_ms, const polyaffine::Vector& states,
                                const polyaffine::Vector& pressures_kPa) const override;

  /// When the first beat begins: of the cavities, kPa, and of all states behind their volumes.
  polyaffine::Vector filling_pressures() const;
  polyaffine::Vector initial_states() const;
  const CirculationNetwork& network() const { return network_; }

 private:
  struct Node {
    int state = -1, cavity = -1, junction = -1;  // where its pressure comes from; none: it is given
  };
  struct Link {
    int from = -1, to = -1, state = -1;  // nodes; the state of an inertance
    Valve valve;                         // with the resistance in series
  };
  // Pressures of the nodes and flows of the links, and what they change by with states and pressures.
  struct Picture {
    polyaffine::Vector pressures, flows, slopes;
    polyaffine::Vector stiffness;  // ∂p/∂(its own state or cavity pressure) of a node
  };

  Picture picture(double time_ms, const polyaffine::Vector& z, const polyaffine::Vector& p) const;
  /// The first valve at a node or beyond a junction next to it; `near` and `far` are the ends of the links.
  int valve_at(int node, int Link::*near, int Link::*far) const;
  void solve_junctions(Picture& at) const;
  void flow_through(std::size_t link, Picture& at) const;
  polyaffine::Vector net_inflow(const polyaffine::Vector& flows) const;  // of every node
  const Element& element_of(const std::vector<int>& links, int cavity) const {
    return network_.elements[static_cast<std::size_t>(links[static_cast<std::size_t>(cavity)])];
  }

  CirculationNetwork network_;
  double period_ms_;
  std::vector<Node> nodes_;
  std::vector<Link> links_;
  std::vector<int> cavities_, inlets_, outlets_;  // node of each cavity; links through its valves
  std::vector<int> junctions_;                    // nodes
  int num_cavities_ = 0, num_states_ = 0;
  Kinds kinds_;
};

}  // namespace cardiac
