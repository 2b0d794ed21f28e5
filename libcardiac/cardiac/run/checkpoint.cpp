#include "cardiac/run/checkpoint.hpp"

#include <cstdint>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include <polyaffine/core/error.hpp>

namespace cardiac {
namespace {

using Json = nlohmann::json;
using polyaffine::InputError;
using polyaffine::Vector;

std::vector<double> numbers(const Vector& v) {
  return {v.begin(), v.end()};
}

Vector vector_of(const Json& list) {
  const auto values = list.get<std::vector<double>>();
  return Eigen::Map<const Vector>(values.data(), static_cast<Eigen::Index>(values.size()));
}

// What must agree: without the keys that change nothing of the beats so far.
Json essential(Json protocol) {
  protocol.erase("output");
  protocol["time"].erase("max_beats");
  return protocol;
}

void check_same(const std::string& what, const std::string& found, const std::string& expected,
                const std::filesystem::path& file) {
  if (found != expected)
    throw InputError(file.string() + ": " + what + ": found " + found + ", expected " + expected +
                     " as of this run; run without --resume to begin anew");
}

void check_protocol(const Json& found, const Json& expected, const std::filesystem::path& file) {
  const Json patch = Json::diff(essential(found), essential(expected));
  if (patch.empty()) return;
  const Json::json_pointer key(patch.front().at("path").get<std::string>());
  const auto value = [&](const Json& protocol) {
    return protocol.contains(key) ? protocol.at(key).dump() : "nothing";
  };
  check_same("protocol" + key.to_string(), value(found), value(expected), file);
}

int count_of(const Json& json, const char* key, const std::filesystem::path& file) {
  const Json& value = json.at(key);
  const bool whole = value.is_number_integer();
  const auto number = whole ? value.get<std::int64_t>() : 0;
  if (!whole || number < 0 || number > std::numeric_limits<int>::max())
    throw InputError(file.string() + ": found a damaged checkpoint (" + key + ": " + value.dump() +
                     ", expected a whole number, at least 0)");
  return static_cast<int>(number);
}

Checkpoint checkpoint_of(const Json& json, const std::filesystem::path& file) {
  const auto count = [&](const char* key) { return count_of(json, key, file); };
  Checkpoint out;
  out.beats = count("beats");
  out.time_steps = count("time_steps");
  out.newton_iterations = count("newton_iterations");
  out.stroke_volumes_mm3 = json.at("stroke_volumes_mm3").get<std::vector<double>>();
  for (const Json& beat : json.at("cycle"))
    out.cycle.push_back({vector_of(beat.at("start")), vector_of(beat.at("end")), beat.at("stroke_mm3")});
  out.min_det_F = json.at("min_det_F");
  out.max_det_F = json.at("max_det_F");
  out.cost.residuals = count("residuals");
  out.cost.factorisations = count("factorisations");
  out.cost.linear_solves = count("linear_solves");
  out.cost.error_test_failures = count("error_test_failures");
  out.cost.convergence_failures = count("convergence_failures");
  out.y = vector_of(json.at("y"));
  out.rate = vector_of(json.at("rate"));
  return out;
}

}  // namespace

std::string checkpoint_text(const Checkpoint& at, const CheckpointOrigin& origin) {
  Json cycle = Json::array();
  for (const CycleBeat& beat : at.cycle)
    cycle.push_back(
        {{"start", numbers(beat.start)}, {"end", numbers(beat.end)}, {"stroke_mm3", beat.stroke_mm3}});
  const Json json{{"version", origin.version},
                  {"mesh", origin.mesh},
                  {"protocol", Json::parse(origin.protocol_json)},
                  {"beats", at.beats},
                  {"time_steps", at.time_steps},
                  {"newton_iterations", at.newton_iterations},
                  {"stroke_volumes_mm3", at.stroke_volumes_mm3},
                  {"cycle", cycle},
                  {"min_det_F", at.min_det_F},
                  {"max_det_F", at.max_det_F},
                  {"residuals", at.cost.residuals},
                  {"factorisations", at.cost.factorisations},
                  {"linear_solves", at.cost.linear_solves},
                  {"error_test_failures", at.cost.error_test_failures},
                  {"convergence_failures", at.cost.convergence_failures},
                  {"y", numbers(at.y)},
                  {"rate", numbers(at.rate)}};
  return json.dump() + "\n";
}

Checkpoint read_checkpoint(const std::filesystem::path& file, const CheckpointOrigin& origin) {
  try {
    std::ifstream stream(file);
    const Json json = Json::parse(stream);
    check_same("version", json.at("version"), origin.version, file);
    check_same("mesh", json.at("mesh"), origin.mesh, file);
    const Json protocol = Json::parse(origin.protocol_json);
    check_protocol(json.at("protocol"), protocol, file);
    Checkpoint out = checkpoint_of(json, file);
    if (out.beats >= protocol.at("time").at("max_beats").get<int>())
      throw InputError(file.string() + ": holds " + std::to_string(out.beats) +
                       " beats, expected fewer than time.max_beats");
    if (out.y.size() != out.rate.size()) throw InputError(file.string() + ": y and rate differ in length");
    if (std::ssize(out.stroke_volumes_mm3) != out.beats)
      throw InputError(file.string() + ": beats and stroke_volumes_mm3 differ in number");
    if (std::ssize(out.cycle) != out.beats)
      throw InputError(file.string() + ": beats and cycle differ in number");
    for (const CycleBeat& beat : out.cycle)
      if (beat.start.size() != out.cycle.front().start.size() || beat.end.size() != beat.start.size())
        throw InputError(file.string() + ": the beats of cycle differ in length");
    return out;
  } catch (const Json::exception& error) {
    throw InputError(file.string() + ": found a damaged checkpoint (" + error.what() + ")");
  }
}

}  // namespace cardiac
