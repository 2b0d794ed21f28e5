#include "heart_model.hpp"

#include <fstream>
#include <sstream>

#include <cardiac/protocol/describe.hpp>
#include <cardiac/training/tuned_archive.hpp>
#include <nlohmann/json.hpp>
#include <polyaffine/core/error.hpp>

namespace cardiac::app {
namespace {

// The sections that are in the heart and its model, as resolved; full order may be asked of any heart.
nlohmann::json fixed_sections(const Protocol& protocol) {
  nlohmann::json all = resolved_json(protocol);
  all["reduction"].erase("method");
  return {all["mesh"], all["anatomy"], all["reduction"]};
}

// What the stress-free shape of an imaged heart depends on beside these.
nlohmann::json passive_sections(const Protocol& protocol) {
  nlohmann::json all = resolved_json(protocol);
  return {all["tissue"], all.contains("region") ? all["region"] : nlohmann::json()};
}

}  // namespace

Protocol load_model(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  const HeartModel model = read_heart_model(file);
  std::vector<std::string> all = model.overrides;
  all.insert(all.end(), overrides.begin(), overrides.end());
  Protocol out = parse_protocol(model.protocol, model.source, all);
  out.heart = model.heart;
  const bool is_unloaded = out.imaged.has_value();
  out.imaged.reset();  // the heart of the file is the stress-free one
  const Protocol learned = parse_protocol(model.protocol, model.source, model.overrides);
  if (fixed_sections(out) != fixed_sections(learned) || structure_key(*out.heart, out) != model.structure)
    throw polyaffine::InputError(file.string() +
                                 ": found --set that changes mesh, anatomy, reduction, fibres, tissue.law, "
                                 "boundary or whether the wall "
                                 "contracts, expected the values that the model was learned for (loads, "
                                 "contraction, tissue parameters and "
                                 "regions may differ)");
  if (is_unloaded && passive_sections(out) != passive_sections(learned))
    out.warnings.push_back("mesh.pressure_mmHg: the stress-free shape in " + file.string() +
                           " is that of the wall that it was learned with; under another tissue or other "
                           "regions the image would "
                           "have another one");
  TunedModel tuned = *model.tuned;
  complete(*out.heart, out, tuned);
  out.tuned = std::make_shared<const TunedModel>(std::move(tuned));
  return out;
}

void save_model(const std::filesystem::path& file, const Protocol& protocol,
                const std::filesystem::path& source, const std::vector<std::string>& overrides) {
  std::ifstream stream(source);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream) throw polyaffine::InputError(source.string() + ": cannot be read");
  std::vector<std::string> all = overrides;
  all.emplace_back("reduction.preset=tuned");
  write_heart_model(file, {text.str(), source.string(), std::move(all),
                           structure_key(*protocol.heart, protocol), protocol.heart, protocol.tuned});
}

}  // namespace cardiac::app
