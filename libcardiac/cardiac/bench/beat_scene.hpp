#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <cardiac/bench/bench.hpp>
#include <cardiac/protocol/protocol.hpp>

namespace cardiac {

inline constexpr auto kBeat = "beat", kBivBeat = "biv_beat";

struct BeatContext {
  /// The protocol of the beat with settings key=value on top.
  std::function<Protocol(const std::vector<std::string>& settings)> protocol;
  std::function<Anatomy(const Protocol&)> anatomy;
  std::string name = kBeat, heart;                       ///< as rows tell them
  std::vector<std::string> presets{"fast", "accurate"};  ///< of the reduced models
  std::vector<std::string> settings;                     ///< key=value for the reduced models
  std::function<void(const std::string& what, double fraction)> progress = [](const auto&, double) {};
  std::function<void(const BenchRow&)> on_row = [](const auto&) {};
};

/// The beats of a protocol by quadratic full order, the reference, and by the presets on the same mesh, on
/// one thread. Displacement, volume and strain are compared at the end systole of each model (Green–Lagrange
/// against the unloaded wall), the rest by BeatErrors. Throws ComputationError when the full-order beat does
/// not complete.
SceneResult run_beat_scene(const BeatContext& context);

}  // namespace cardiac
