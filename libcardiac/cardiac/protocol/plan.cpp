#include <algorithm>
#include <stdexcept>

#include <cardiac/protocol/names.hpp>
#include <cardiac/protocol/plan.hpp>
#include <cardiac/protocol/rules.hpp>

namespace cardiac {
namespace {

using namespace protocol;

PlanItem mesh_item(const Protocol& protocol) {
  const Mesh& mesh = protocol.mesh;
  if (mesh.file) return {"mesh", true, "read from " + mesh_path(protocol).string()};
  return {"mesh", true, "idealised shape " + name_of(*mesh.shape)};
}

PlanItem fibres_item(const Protocol& protocol) {
  const std::string why = why_fibres(protocol);
  if (!why.empty() && protocol.fibres->source == FibreSource::file)
    return {"fibres", true, why + "; those of " + mesh_path(protocol).string() + " (fibres.source = file)"};
  if (!why.empty())
    return {"fibres", true,
            why + "; by the rule " + name_of(protocol.fibres->rule) + " (fibres.source = rule)"};
  const std::string idle = "the law " + name_of(protocol.tissue.law) + " is isotropic and nothing contracts";
  return {"fibres", false, protocol.fibres ? "[fibres] is named, but " + idle : idle};
}

PlanItem activation_item(const Protocol& protocol) {
  if (!protocol.contraction) {
    return {"activation", false,
            protocol.activation ? "[activation] is named, but nothing contracts" : "nothing contracts"};
  }
  switch (protocol.activation->mode) {
    case ActivationMode::uniform:
      return {"activation", true, "the same time everywhere"};
    case ActivationMode::array:
      return {"activation", true, "times of a point array of the mesh"};
    case ActivationMode::table:
      return {"activation", true, "times of the points of " + *protocol.activation->file};
    case ActivationMode::sites:
      break;
  }
  return {"activation", true, "eikonal wave from the sites"};
}

PlanItem contraction_item(const Protocol& protocol) {
  if (!protocol.contraction) return {"contraction", false, "no table [contraction]"};
  return {"contraction", true, "model " + name_of(protocol.contraction->model)};
}

PlanItem cavity_item(const Protocol& protocol) {
  if (protocol.circulation) return {"cavity", true, "its volume couples to the circulation"};
  if (protocol.cavities && protocol.cavities->volume_file)
    return {"cavity", true, "its volume over the time is given: " + *protocol.cavities->volume_file};
  if (protocol.cavities && protocol.cavities->pressure_file)
    return {"cavity", true, "its pressure over the time is given: " + *protocol.cavities->pressure_file};
  if (protocol.cavities) return {"cavity", true, "a pressure is prescribed in it"};
  return {"cavity", false, "neither [cavities] nor [circulation]: no pressure acts"};
}

PlanItem circulation_item(const Protocol& protocol) {
  if (protocol.circulation && protocol.circulation->network) {
    const CirculationNetwork& network = *protocol.circulation->network;
    return {"circulation", true,
            "network of " + std::to_string(network.compartments.size()) + " compartments and " +
                std::to_string(network.elements.size()) + " elements"};
  }
  if (protocol.circulation && protocol.circulation->loop == Loop::closed_2022)
    return {"circulation", true, "closed loop with atria of Regazzoni 2022"};
  if (protocol.circulation)
    return {"circulation", true,
            protocol.anatomy.scheme == Scheme::aha29 ? "closed loop of two windkessels with four valves"
                                                     : "three-element windkessel with two valves"};
  return {"circulation", false, protocol.cavities ? "the pressure is prescribed" : "no table [circulation]"};
}

PlanItem regions_item(const Protocol& protocol) {
  if (protocol.regions.empty()) return {"regions", false, "no table [[region]]: every segment is alike"};
  std::string why = std::to_string(protocol.regions.size()) + " named by [[region]]";
  if (!regions_differ(protocol)) why += ", none of which differs from the rest";
  return {"regions", true, why};
}

PlanItem reduction_item(const Reduction& reduction, Scheme scheme) {
  std::string why = "reduction.method = " + name_of(reduction.method);
  if (reduction.method == Method::fem) return {"reduction", false, why};
  int nodes = 1;
  std::string rings = "the cap";
  for (const int n : reduction.ring_nodes) {
    nodes += n;
    rings += " + " + std::to_string(n);
  }
  if (scheme == Scheme::aha29) {
    nodes += 12;
    rings += " + 12 of the right free wall";
  }
  std::string functions;
  for (const std::string& word : *reduction.enrichment) functions += " + " + word;
  if (*reduction.border_functions) functions += " + borders of segments that differ";
  return {
      "reduction", true,
      why + ", " + std::to_string(nodes) + " control nodes (" + rings + "), functions affine" + functions};
}

PlanItem output_item(std::string part, bool wanted, const std::string& key) {
  return {std::move(part), wanted, key + (wanted ? " = true" : " = false")};
}

}  // namespace

std::vector<PlanItem> plan(const Protocol& protocol, bool verify) {
  const bool reduced = protocol.reduction.method == Method::polyaffine;
  const std::string method = "reduction.method = " + name_of(protocol.reduction.method);
  std::vector<PlanItem> items = {
      mesh_item(protocol),
      {"coordinates", true, "segments, local axes and strain need them"},
      {"segments", true, "strain is told by segment (" + name_of(*protocol.anatomy.scheme) + ")"},
      fibres_item(protocol),
      activation_item(protocol),
      contraction_item(protocol),
      cavity_item(protocol),
      circulation_item(protocol),
      regions_item(protocol),
      reduction_item(protocol.reduction, *protocol.anatomy.scheme),
      {"full order", !reduced || verify, reduced && verify ? "--verify" : method}};
  if (protocol.imaged)
    items.push_back({"unloading", true, "mesh.pressure_mmHg: the stress-free shape of the imaged mesh"});
  if (reduced && verify) {
    items.push_back({"verification", true, "--verify: full order at end diastole and end systole"});
  } else {
    items.push_back({"verification", false, verify ? "the run is full order itself" : "no --verify"});
  }
  items.push_back(output_item("tables", protocol.output.tables, "output.tables"));
  items.push_back(output_item("mechanics", protocol.output.mechanics, "output.mechanics"));
  items.push_back(output_item("figures", protocol.output.figures, "output.figures"));
  items.push_back(output_item("mesh series", protocol.output.mesh_series, "output.mesh_series"));
  return items;
}

bool builds(const std::vector<PlanItem>& items, const std::string& part) {
  const auto found = std::ranges::find(items, part, &PlanItem::part);
  if (found == items.end()) throw std::out_of_range("no part \"" + part + "\" in the plan");
  return found->built;
}

}  // namespace cardiac
