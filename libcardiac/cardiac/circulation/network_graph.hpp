#pragma once

#include <map>
#include <string>
#include <vector>

#include <cardiac/circulation/network.hpp>

namespace cardiac {

/// A network put together from points of the same pressure, as files of other programs tell it: points that
/// are joined become one compartment, which is what some of them hold, or a junction.
class NetworkGraph {
 public:
  /// The point of a name; made where there is none.
  int point(const std::string& name);
  void join(int a, int b);
  /// What a point holds: a compliance (of joined points they add up), a chamber or a given pressure.
  void hold(int point, Compartment compartment);
  /// Adds an element between two points; its ends are named by them.
  void connect(Element element, int from, int to);

  /// The network. Junctions between two elements alone are left out, the elements becoming one. Throws
  /// polyaffine::InputError, `source` first, where a chamber is joined with another or a compliance, and for
  /// a network with a fault.
  CirculationNetwork network(const std::string& source, double period_ms) const;

 private:
  struct Held {
    int point;
    Compartment compartment;
  };
  struct Tie {
    Element element;
    int from, to;
  };
  int root(int point) const;

  std::map<std::string, int> points_;
  std::vector<int> parents_;
  std::vector<std::string> names_;
  std::vector<Held> held_;
  std::vector<Tie> ties_;
};

}  // namespace cardiac
