#pragma once

#include <filesystem>
#include <optional>

#include <cardiac/anatomy/heart_mesh.hpp>

namespace cardiac::app {

/// Is it from a file of triangles (.stl, .off, .obj, .ply, .vtp), or from one of VTK that has no others?
bool is_surface(const polyaffine::MeshData& data);

/// Fills a closed surface with tetrahedra of edges of about size_mm (absent: half the mean thickness of the
/// wall, 2 V / A) and recognises its parts. Labels are read and checked before: triangles of labels without a
/// meaning that make the surface meet itself, as caps of a cavity do, are left out with a note. Throws
/// InputError naming file and place when the surface is not closed, not manifold or meets itself, or as
/// make_heart_mesh, and when this build lacks CGAL.
HeartMesh fill_surface(polyaffine::MeshData data, const HeartMeshOptions& options,
                       std::optional<double> size_mm);

}  // namespace cardiac::app
