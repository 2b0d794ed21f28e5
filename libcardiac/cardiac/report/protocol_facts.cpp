#include <cardiac/report/protocol_facts.hpp>

#include <nlohmann/json.hpp>

#include <cardiac/report/text.hpp>

namespace cardiac {
namespace {

using Json = nlohmann::ordered_json;

/// The value at table.key, null where it or the table is missing.
Json value_at(const Json& protocol, const std::string& table, const std::string& key) {
  if (!protocol.is_object()) return nullptr;
  const auto held = protocol.find(table);
  if (held == protocol.end() || !held->is_object()) return nullptr;
  const auto value = held->find(key);
  return value == held->end() ? Json(nullptr) : *value;
}

std::string vector_text(const Json& vector) {
  std::string text = "(";
  for (const Json& part : vector)
    text +=
        (text.size() > 1 ? ", " : "") + (part.is_number() ? number_text(part.get<double>()) : part.dump());
  return text + ")";
}

std::string base_sentence(const Json& protocol) {
  const Json base = value_at(protocol, "boundary", "base");
  if (!base.is_string() || base == "clamped")
    return "The base is clamped: the valve plane neither moves nor turns, and all shortening draws the apex "
           "up. "
           "In healthy adults the valve plane itself moves by 12 to 15 mm.";
  if (base == "sliding")
    return "The base slides in its plane and does not move along its normal (boundary.base = sliding); the "
           "apex "
           "is drawn up.";
  if (base == "elastic")
    return "Springs and dashpots hold the base, which moves (boundary.base = elastic); the pressure on the "
           "closed "
           "valves is borne by their rings.";
  return "The base is held by boundary.base = " + base.get<std::string>() + ".";
}

std::string stress_sentence(const Json& protocol) {
  const Json pressure = value_at(protocol, "mesh", "pressure_mmHg");
  if (pressure.is_number())
    return "The mesh was imaged at " + number_text(pressure.get<double>()) +
           " mmHg (mesh.pressure_mmHg); the run starts from the shape without load.";
  return "The mesh is taken as free of stress: its shape is that of the unloaded heart. A mesh from an image "
         "taken under pressure comes out larger than the heart that it shows.";
}

std::string anterior_sentence(const Json& protocol, bool right_ventricle) {
  if (right_ventricle)
    return "The right ventricle tells where the septum, and so the anterior wall, is; segments are counted "
           "from "
           "its anterior insertion.";
  const Json given = value_at(protocol, "anatomy", "anterior_direction");
  if (given.is_array())
    return "The anterior wall lies in the direction " + vector_text(given) +
           " of the mesh (anatomy.anterior_direction).";
  for (const char* key : {"septum_point", "rv_insertion_point"})
    if (const Json point = value_at(protocol, "anatomy", key); point.is_array())
      return std::string("Where the anterior wall lies is told by anatomy.") + key + " = " +
             vector_text(point) + ".";
  return "The anterior wall is taken to lie in the direction (0, 1, 0) of the mesh: the protocol does not "
         "tell "
         "where it is (anatomy.anterior_direction). If it lies elsewhere, every segment's number is that of "
         "another wall.";
}

std::string axis_sentence(const Json& protocol) {
  const Json given = value_at(protocol, "anatomy", "long_axis");
  if (given.is_array())
    return "The long axis has the direction " + vector_text(given) + " of the mesh (anatomy.long_axis).";
  return "The long axis runs from the apex of the cavity to the centre of the base or mitral opening, found "
         "on "
         "the mesh (where it is within 3° of the normal of a flat base, along that normal); longitudinal, "
         "circumferential and radial are told by it.";
}

std::string outside_sentence(const Json& protocol) {
  const auto number = [&](const char* key) {
    const Json value = value_at(protocol, "boundary", key);
    return value.is_number() ? value.get<double>() : 0.0;
  };
  const double stiffness = number("epicardial_stiffness_kPa_per_mm"),
               damping = number("epicardial_damping_kPa_ms_per_mm");
  std::string what;
  if (stiffness > 0) what = "Springs of " + number_text(stiffness) + " kPa/mm";
  if (damping > 0)
    what += (what.empty() ? "Dashpots of " : " and dashpots of ") + number_text(damping) + " kPa·ms/mm";
  if (what.empty()) return "Nothing holds the outer wall: no pericardium, no neighbours.";
  const bool all = value_at(protocol, "boundary", "epicardial_directions") == "all";
  return what + (all ? " in all directions" : " along the normal") +
         " hold the outer wall (boundary.epicardial_stiffness_kPa_per_mm, epicardial_damping_kPa_ms_per_mm).";
}

}  // namespace

std::vector<NamedRegion> regions_of(const std::string& protocol_json) {
  const Json protocol = Json::parse(protocol_json, nullptr, false);
  std::vector<NamedRegion> regions;
  if (!protocol.is_object() || !protocol.contains("region") || !protocol["region"].is_array()) return regions;
  for (const Json& table : protocol["region"]) {
    NamedRegion& region = regions.emplace_back();
    if (!table.is_object()) continue;
    if (const auto name = table.find("name"); name != table.end() && name->is_string())
      region.name = name->get<std::string>();
    if (const auto segments = table.find("segments"); segments != table.end() && segments->is_array())
      for (const Json& number : *segments)
        if (number.is_number_integer()) region.segments.push_back(number.get<int>());
  }
  for (size_t i = 0; i < regions.size(); ++i)
    if (regions[i].name.empty()) regions[i].name = "region " + std::to_string(i + 1);
  std::erase_if(regions, [](const NamedRegion& region) { return region.segments.empty(); });
  return regions;
}

std::vector<std::string> assumptions_of(const std::string& protocol_json, bool right_ventricle) {
  const Json protocol = Json::parse(protocol_json, nullptr, false);
  return {stress_sentence(protocol), base_sentence(protocol), outside_sentence(protocol),
          axis_sentence(protocol), anterior_sentence(protocol, right_ventricle)};
}

}  // namespace cardiac
