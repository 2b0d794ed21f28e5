#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <cardiac/protocol/sections.hpp>

namespace cardiac {

/// A scene as a text (TOML) tells it, with the mesh that it names: checked, defaults filled in, every number
/// in the units of a scene. `heart` is empty until the mesh has been read.
struct Protocol : Scene {
  protocol::Mesh mesh;
  protocol::Anatomy anatomy;
  std::vector<protocol::NetworkCompartment> compartments;  ///< of the circulation's network
  std::vector<protocol::NetworkElement> elements;

  std::filesystem::path directory;    ///< of the protocol file; mesh.file is relative to it
  std::vector<std::string> warnings;  ///< keys that were given but play no part, each with its reason
  bool scheme_assumed = false;  ///< aha17 until the mesh file is read: neither key nor shape tells the scheme
};

/// Path of the mesh file; only with a mesh.file.
std::filesystem::path mesh_path(const Protocol& protocol);

/// Path of the second file with labelled triangles; only with a mesh.surface_file.
std::filesystem::path surface_path(const Protocol& protocol);

/// Throws polyaffine::InputError when the mesh.file or mesh.surface_file of the protocol does not exist.
void check_mesh_file(const Protocol& protocol);

/// Reads a protocol file (.toml). `overrides` are texts `key.path=value`, the value in TOML (a bare word is
/// taken as text, relative paths start at the current folder); they replace what the file says. Throws
/// polyaffine::InputError, naming file, line or option, key, what was found, what was expected and the unit.
Protocol load_protocol(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// The same from a text; `source` stands for the file in messages and gives the directory.
Protocol parse_protocol(const std::string& text, const std::filesystem::path& source,
                        const std::vector<std::string>& overrides = {});

}  // namespace cardiac
