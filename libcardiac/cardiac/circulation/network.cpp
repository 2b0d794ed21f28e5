#include "cardiac/circulation/network.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace cardiac {
namespace {

bool is_word(const std::string& name) {
  const auto fits = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  };
  return !name.empty() && std::ranges::all_of(name, fits);
}

std::string quoted(const std::string& text) {
  return '"' + text + '"';
}

// Whether a valve is at a compartment or beyond a junction next to it; `near` and `far` are the ends of
// elements on the way.
bool has_valve(const CirculationNetwork& network, const std::string& name, std::string Element::*near,
               std::string Element::*far) {
  const auto at = [&](const std::string& end) {
    return std::ranges::any_of(
        network.elements, [&](const Element& e) { return e.type == ElementType::valve && e.*near == end; });
  };
  return at(name) || std::ranges::any_of(network.elements, [&](const Element& e) {
           const auto next = std::ranges::find(network.compartments, e.*far, &Compartment::name);
           return e.*near == name && next != network.compartments.end() &&
                  next->type == CompartmentType::junction && at(e.*far);
         });
}

constexpr const char* kWord = ", expected a name of letters, digits and underscores";

std::optional<NetworkFault> fault_of_compartment(const CirculationNetwork& network, std::size_t i) {
  const Compartment& c = network.compartments[i];
  const auto fault = [&](const std::string& key, const std::string& text) {
    return NetworkFault{false, i, key, text};
  };
  if (!is_word(c.name)) return fault("name", "found " + quoted(c.name) + kWord);
  for (std::size_t j = 0; j < i; ++j) {
    const Compartment& other = network.compartments[j];
    if (other.name == c.name)
      return fault("name", "found " + quoted(c.name) + " twice, expected a name of its own");
    if (c.type == CompartmentType::ventricle && other.type == c.type && other.cavity == c.cavity)
      return fault("cavity", "found the cavity of " + quoted(other.name) + " again, expected another one");
  }
  if (c.type == CompartmentType::vessel && !(c.compliance_mm3_per_kPa > 0))
    return fault("compliance_mL_per_mmHg", "missing; expected the compliance of the vessel " +
                                               quoted(c.name) +
                                               " above 0 mL/mmHg (a compartment without one is a junction)");
  if (c.type == CompartmentType::chamber) {
    const Elastance& e = c.chamber.elastance;
    if (!(e.passive_kPa_per_mm3 > 0 || c.chamber.passive_kPa > 0 || c.chamber.activity == Activity::fourier))
      return fault("passive_elastance_mmHg_per_mL", "missing; expected the elastance of the chamber " +
                                                        quoted(c.name) + " at rest, above 0 mmHg/mL");
    if (c.chamber.activity == Activity::cosine && !(e.contraction_ms > 0 && e.relaxation_ms > 0))
      return fault("contraction_ms", "missing; expected how long the chamber " + quoted(c.name) +
                                         " contracts and relaxes, above 0 ms");
  }
  return {};
}

std::optional<NetworkFault> fault_of_element(const CirculationNetwork& network, std::size_t i) {
  const Element& e = network.elements[i];
  const auto fault = [&](const std::string& key, const std::string& text) {
    return NetworkFault{true, i, key, text};
  };
  if (!is_word(e.name)) return fault("name", "found " + quoted(e.name) + kWord);
  for (std::size_t j = 0; j < i; ++j)
    if (network.elements[j].name == e.name)
      return fault("name", "found " + quoted(e.name) + " twice, expected a name of its own");
  std::string known;
  for (const Compartment& c : network.compartments) known += (known.empty() ? "" : ", ") + c.name;
  for (const auto& [key, end] : {std::pair{"from", &e.from}, std::pair{"to", &e.to}})
    if (std::ranges::find(network.compartments, *end, &Compartment::name) == network.compartments.end())
      return fault(key, "found " + quoted(*end) + ", expected the name of a compartment: " + known);
  if (e.from == e.to)
    return fault("to", "found " + quoted(e.to) + " as both ends, expected two compartments");
  const double R = e.valve.resistance_kPa_ms_per_mm3, L = e.inertance_kPa_ms2_per_mm3;
  if (!(R > 0) && !e.curve && (e.type == ElementType::valve || !(L > 0)))
    return fault("resistance_mmHg_s_per_mL",
                 "missing; expected the resistance of " + quoted(e.name) + ", above 0 mmHg·s/mL");
  if (!e.between.empty()) {
    const bool taken =
        std::ranges::find(network.compartments, e.between, &Compartment::name) != network.compartments.end();
    if (!is_word(e.between) || taken)
      return fault("between", "found " + quoted(e.between) + ", expected a name of letters, digits and " +
                                  "underscores that no compartment has");
  }
  if (e.type != ElementType::valve) return {};
  const bool tight = !std::isfinite(e.valve.leak_kPa_ms_per_mm3);
  if (tight && (L > 0 || e.valve.law != ValveLaw::smooth))
    return fault("leak_resistance_mmHg_s_per_mL", "missing; expected the resistance of the closed valve " +
                                                      quoted(e.name) + ": its law or inertance needs one");
  if (e.valve.law == ValveLaw::smooth) return {};
  if (!(e.valve.sharpness_per_kPa > 0))
    return fault("sharpness_per_mmHg",
                 "missing; expected how sharply the valve " + quoted(e.name) + " closes, above 0 1/mmHg");
  if (L > 0 || e.series_kPa_ms_per_mm3 > 0 || e.valve.stenosis_kPa_ms2_per_mm6 > 0)
    return fault("law", "found a law beside an inertance, stenosis or series resistance of " +
                            quoted(e.name) + ", expected the law smooth");
  return {};
}

// A ventricle fills and empties through valves.
std::optional<NetworkFault> fault_of_ventricle(const CirculationNetwork& network, std::size_t i) {
  const Compartment& c = network.compartments[i];
  const auto fault = [&](const std::string& key, const std::string& text) {
    return NetworkFault{false, i, key, text};
  };
  const bool filled = has_valve(network, c.name, &Element::to, &Element::from);
  if (!filled || !has_valve(network, c.name, &Element::from, &Element::to))
    return fault("name", "found no valve " + std::string(filled ? "from " : "to ") + quoted(c.name) +
                             ", expected one to a ventricle and one from it");
  return {};
}

// A junction needs something through which its pressure changes a flow both ways.
std::optional<NetworkFault> fault_of_junction(const CirculationNetwork& network, std::size_t i) {
  const Compartment& c = network.compartments[i];
  const auto fault = [&](const std::string& text) { return NetworkFault{false, i, "type", text}; };
  bool gives = false;
  for (const Element& e : network.elements) {
    if (e.from != c.name && e.to != c.name) continue;
    if (e.type == ElementType::valve && e.valve.law == ValveLaw::arctan)
      return fault("found the valve " + quoted(e.name) + " of the law arctan at the junction " +
                   quoted(c.name) + ", expected the law smooth or tanh there");
    if (e.inertance_kPa_ms2_per_mm3 > 0 || e.curve) continue;
    gives = gives || e.type != ElementType::valve || std::isfinite(e.valve.leak_kPa_ms_per_mm3);
  }
  if (gives) return {};
  return fault("found only inertances, tight valves and given flows at the junction " + quoted(c.name) +
               ", expected a resistance or a leaking valve there, or a vessel instead");
}

std::optional<NetworkFault> fault_of_parts(const CirculationNetwork& network) {
  std::set<std::string> reached{network.compartments.front().name};
  for (bool more = true; more;) {
    more = false;
    for (const Element& e : network.elements)
      if (reached.contains(e.from) != reached.contains(e.to)) {
        reached.insert({e.from, e.to});
        more = true;
      }
  }
  for (std::size_t i = 0; i < network.compartments.size(); ++i)
    if (!reached.contains(network.compartments[i].name))
      return NetworkFault{false, i, "name",
                          quoted(network.compartments[i].name) + " is not connected with " +
                              quoted(network.compartments.front().name) + ", expected one circulation"};
  return {};
}

}  // namespace

double TimeSeries::at(double time_ms) const {
  if (times_ms.size() == 1) return values.front();
  const double period = times_ms.back() - times_ms.front();
  const double t = time_ms - period * std::floor((time_ms - times_ms.front()) / period);
  const auto after = std::ranges::upper_bound(times_ms, t);
  if (after == times_ms.end()) return values.back();
  if (after == times_ms.begin()) return values.front();
  const auto i = static_cast<std::size_t>(after - times_ms.begin());
  const double s = (t - times_ms[i - 1]) / (times_ms[i] - times_ms[i - 1]);
  return values[i - 1] + s * (values[i] - values[i - 1]);
}

std::optional<NetworkFault> fault_of(const CirculationNetwork& network) {
  if (network.compartments.empty())
    return NetworkFault{false, 0, "", "found no compartment, expected at least two"};
  for (std::size_t i = 0; i < network.compartments.size(); ++i)
    if (auto fault = fault_of_compartment(network, i)) return fault;
  for (std::size_t i = 0; i < network.elements.size(); ++i)
    if (auto fault = fault_of_element(network, i)) return fault;
  for (std::size_t i = 0; i < network.compartments.size(); ++i) {
    const CompartmentType type = network.compartments[i].type;
    auto fault = type == CompartmentType::ventricle  ? fault_of_ventricle(network, i)
                 : type == CompartmentType::junction ? fault_of_junction(network, i)
                                                     : std::nullopt;
    if (fault) return fault;
  }
  return fault_of_parts(network);
}

}  // namespace cardiac
