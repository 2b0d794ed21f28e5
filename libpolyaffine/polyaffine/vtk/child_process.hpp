#pragma once

#include <functional>

#include <polyaffine/mesh_io/mesh_data.hpp>

namespace polyaffine {

/// What `read` makes of a file, computed in a child process: VTK's readers trust what a file announces, and a
/// damaged one may crash them, let them run on, or ask for all memory. The child may use 256 MB and a hundred
/// times the size of the file, and 4 s and a second for each MB. Throws InputError as `read` does or, naming
/// the file, when the child died or went beyond its limits; ComputationError when no child can be started.
MeshData read_in_child(const std::filesystem::path& file, const std::function<MeshData()>& read);

}  // namespace polyaffine
