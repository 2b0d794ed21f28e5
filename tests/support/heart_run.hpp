#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include <cardiac/protocol/build_anatomy.hpp>
#include <cardiac/run/simulate.hpp>
#include <polyaffine/vtk/read.hpp>

namespace cardiac::testing {

/// A shipped protocol, by the name of its file.
inline Protocol shipped_protocol(const std::string& name, const std::vector<std::string>& overrides = {}) {
  return load_protocol(PROJECT_DIR "/protocols/" + name + ".toml", overrides);
}

/// Overrides that put a protocol on the coarse mesh of Land's ellipsoid.
inline std::vector<std::string> on_land_ellipsoid(std::vector<std::string> more = {}) {
  more.emplace_back("mesh.file=\"" PROJECT_DIR "/meshes/land_ellipsoid_coarse.vtu\"");
  return more;
}

inline std::shared_ptr<const Anatomy> read_anatomy(const Protocol& protocol) {
  return std::make_shared<const Anatomy>(
      build_anatomy(polyaffine::read_vtu(mesh_path(protocol), 1), protocol));
}

inline std::vector<ControlNode> control_nodes_of(const Anatomy& anatomy) {
  return control_nodes(anatomy.mesh, *anatomy.coordinates, frame_layout(anatomy.mesh, *anatomy.coordinates));
}

/// A protocol with all that its run gives.
struct HeartRun {
  Protocol protocol;
  Ventricle ventricle;
  HeartPath path;
  BeatResult result;
  KeyStates key;

  explicit HeartRun(const Protocol& of) : HeartRun(of, read_anatomy(of)) {}
  HeartRun(Protocol of, std::shared_ptr<const Anatomy> anatomy) : protocol(std::move(of)) {
    protocol.heart = std::move(anatomy);
    Outcome outcome = simulate(protocol, {.keep_absurd = true});
    ventricle = std::move(outcome.model);
    path = std::move(outcome.path);
    result = std::move(outcome.result);
    key = key_states(path, protocol);
  }
};

/// The run of a shipped protocol as it is, computed once a test program.
inline const HeartRun& shipped_run(const std::string& name) {
  static std::map<std::string, HeartRun> runs;
  auto found = runs.find(name);
  if (found == runs.end()) found = runs.emplace(name, HeartRun(shipped_protocol(name))).first;
  return found->second;
}

}  // namespace cardiac::testing
