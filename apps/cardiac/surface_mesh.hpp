#pragma once

#include <filesystem>
#include <optional>

#include <cardiac/anatomy/heart_mesh.hpp>

namespace cardiac::app {

/// Is it a file of triangles by its extension (.stl, .off, .obj, .ply, .vtp)?
bool is_surface_file(const std::filesystem::path& file);

/// Fills a closed surface with tetrahedra of edges of about size_mm (absent: half the mean thickness of the
/// wall, 2 V / A) and recognises its parts. Throws InputError naming file and place when the surface is not
/// closed, not manifold or meets itself, or as make_heart_mesh, and when this build lacks CGAL.
HeartMesh fill_surface(const std::filesystem::path& file, const HeartMeshOptions& options,
                       std::optional<double> size_mm);

}  // namespace cardiac::app
