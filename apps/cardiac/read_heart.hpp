#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <cardiac/anatomy/heart_mesh.hpp>
#include <cardiac/protocol/sections.hpp>

namespace cardiac::app {

/// The unit behind a word of --length-unit. Throws InputError for another word.
protocol::LengthUnit length_unit(const std::string& word);

/// Labels as words of a command line: numbers or names.
std::vector<SurfaceLabel> surface_labels(const std::vector<std::string>& words);

/// Reads any mesh file by its extension. Throws InputError as the readers, and when this build lacks VTK
/// and the file is none of .vtu.
polyaffine::MeshData read_any_mesh(const std::filesystem::path& file);

/// Reads a heart from a file of tetrahedra and, unless it is empty, a second file with its labelled
/// triangles. Throws InputError as read_any_mesh and make_heart_mesh.
HeartMesh read_heart(const std::filesystem::path& file, const std::filesystem::path& surface_file,
                     const HeartMeshOptions& options);

}  // namespace cardiac::app
