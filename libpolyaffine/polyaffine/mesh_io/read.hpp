#pragma once

#include <polyaffine/mesh_io/mesh_data.hpp>

namespace polyaffine {

/// Does a reader of this folder know the extension (.vtu; .msh; .pts, .elem, .lon; .stl, .off, .obj, .ply;
/// in small or capital letters)?
bool has_reader(const std::filesystem::path& file);

/// Reads a mesh by the extension of its file. Throws InputError for an extension without a reader, or as the
/// reader does.
MeshData read_mesh_data(const std::filesystem::path& file);

}  // namespace polyaffine
