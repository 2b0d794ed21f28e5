#include "cardiac/circulation/network_graph.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include <polyaffine/core/error.hpp>

namespace cardiac {
namespace {

using polyaffine::InputError;

// A name of letters, digits and underscores that none of `taken` is.
std::string word_of(const std::string& name, std::set<std::string>& taken) {
  std::string word;
  for (const char c : name) {
    const bool fits = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    word += fits ? c : '_';
  }
  std::string out = word;
  for (int n = 2; !taken.insert(out).second; ++n) out = word + '_' + std::to_string(n);
  return out;
}

bool is_plain(const Element& e) {
  return e.type == ElementType::resistance && !e.curve;
}

// Leaves out junctions that only two elements meet at, one behind the other.
void merge_chains(CirculationNetwork& network) {
  for (std::size_t i = 0; i < network.compartments.size();) {
    const std::string name = network.compartments[i].name;
    std::optional<std::size_t> in, out;
    int count = 0;
    for (std::size_t e = 0; e < network.elements.size(); ++e) {
      if (network.elements[e].to == name) in = e;
      if (network.elements[e].from == name) out = e;
      count += (network.elements[e].to == name ? 1 : 0) + (network.elements[e].from == name ? 1 : 0);
    }
    const bool merges = network.compartments[i].type == CompartmentType::junction && count == 2 && in &&
                        out && is_plain(network.elements[*in]) && is_plain(network.elements[*out]);
    if (!merges) {
      ++i;
      continue;
    }
    Element& first = network.elements[*in];
    const Element& second = network.elements[*out];
    first.to = second.to;
    first.valve.resistance_kPa_ms_per_mm3 += second.valve.resistance_kPa_ms_per_mm3;
    first.valve.stenosis_kPa_ms2_per_mm6 += second.valve.stenosis_kPa_ms2_per_mm6;
    if (first.inertance_kPa_ms2_per_mm3 == 0) first.initial_flow_mm3_per_ms = second.initial_flow_mm3_per_ms;
    first.inertance_kPa_ms2_per_mm3 += second.inertance_kPa_ms2_per_mm3;
    network.elements.erase(network.elements.begin() + static_cast<std::ptrdiff_t>(*out));
    network.compartments.erase(network.compartments.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

}  // namespace

int NetworkGraph::point(const std::string& name) {
  const auto [found, is_new] = points_.emplace(name, static_cast<int>(parents_.size()));
  if (is_new) {
    parents_.push_back(found->second);
    names_.push_back(name);
  }
  return found->second;
}

int NetworkGraph::root(int point) const {
  while (parents_[static_cast<std::size_t>(point)] != point)
    point = parents_[static_cast<std::size_t>(point)];
  return point;
}

void NetworkGraph::join(int a, int b) {
  parents_[static_cast<std::size_t>(root(b))] = root(a);
}

void NetworkGraph::hold(int point, Compartment compartment) {
  held_.push_back({point, std::move(compartment)});
}

void NetworkGraph::connect(Element element, int from, int to) {
  ties_.push_back({std::move(element), from, to});
}

CirculationNetwork NetworkGraph::network(const std::string& source, double period_ms) const {
  CirculationNetwork out;
  out.period_ms = period_ms;
  std::set<std::string> taken;
  std::map<int, std::string> name_of;
  std::map<int, std::size_t> at;
  for (const Held& held : held_) {
    const int r = root(held.point);
    const auto [found, is_new] = at.emplace(r, out.compartments.size());
    if (is_new) {
      out.compartments.push_back(held.compartment);
      out.compartments.back().name = name_of[r] = word_of(held.compartment.name, taken);
      continue;
    }
    Compartment& there = out.compartments[found->second];
    const Compartment& more = held.compartment;
    if (there.type == CompartmentType::vessel && more.type == CompartmentType::vessel)
      there.compliance_mm3_per_kPa += more.compliance_mm3_per_kPa;
    else if (there.type == CompartmentType::vessel && more.type == CompartmentType::pressure)
      there = [&] {
        Compartment given = more;
        given.name = there.name;
        return given;
      }();
    else if (there.type != CompartmentType::pressure || more.type != CompartmentType::vessel)
      throw InputError(source + ": \"" + there.name + "\" and \"" + more.name +
                       "\" are at the same pressure, expected a resistance, inertance or valve between them");
  }
  for (const Tie& tie : ties_)
    for (const int end : {root(tie.from), root(tie.to)}) {
      if (name_of.contains(end)) continue;
      Compartment junction;
      junction.type = CompartmentType::junction;
      const std::string& name = names_[static_cast<std::size_t>(end)];
      junction.name = name_of[end] =
          word_of(name.ends_with(":in") ? name.substr(0, name.size() - 3) : name, taken);
      out.compartments.push_back(std::move(junction));
    }
  std::set<std::string> elements;
  for (const Tie& tie : ties_) {
    Element element = tie.element;
    element.name = word_of(element.name, elements);
    element.from = name_of.at(root(tie.from));
    element.to = name_of.at(root(tie.to));
    if (element.from != element.to) out.elements.push_back(std::move(element));
  }
  merge_chains(out);
  if (const auto fault = fault_of(out)) throw InputError(source + ": " + fault->text);
  return out;
}

}  // namespace cardiac
