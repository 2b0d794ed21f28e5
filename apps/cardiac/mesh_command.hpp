#pragma once

#include <CLI/CLI.hpp>

#include <cardiac/anatomy/idealised.hpp>
#include <polyaffine/mesh/tet_mesh.hpp>

/// Tetrahedra between the ellipsoids, about size_mm long, with the labels of idealised.hpp on the boundary
/// and every boundary vertex on the exact surface. Throws InputError for a wrong shape or size, or when the
/// program was built without CGAL.
polyaffine::TetMesh mesh_truncated_ellipsoid(const cardiac::TruncatedEllipsoid& shape, double size_mm);

/// Registers `cardiac mesh ellipsoid`; the command sets status to 0 when it is done.
void add_mesh_command(CLI::App& app, int& status);
