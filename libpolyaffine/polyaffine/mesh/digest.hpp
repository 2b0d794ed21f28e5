#pragma once

#include <string>

#include <polyaffine/mesh/tet_mesh.hpp>

namespace polyaffine {

/// Numbers of vertices and tets and a checksum (64-bit FNV-1a) of points, tets, regions and labels: two
/// meshes with the same text are the same but for a chance of 10⁻¹⁹.
std::string digest(const TetMesh& mesh);

/// The checksum of values by themselves, hexadecimal.
std::string digest(const Matrix& values);

}  // namespace polyaffine
