#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <cardiac/protocol/protocol.hpp>

namespace cardiac::app {

/// The protocol of a model file with further overrides, its heart and its tuned model: what `run --model`
/// runs. Throws InputError when an override changes what the model was learned for (structure_key).
Protocol load_model(const std::filesystem::path& file, const std::vector<std::string>& overrides);

/// Writes the protocol's heart with its tuned model (Scene::tuned). `source` and `overrides` are what the
/// protocol was loaded from.
void save_model(const std::filesystem::path& file, const Protocol& protocol,
                const std::filesystem::path& source, const std::vector<std::string>& overrides);

}  // namespace cardiac::app
