#pragma once

#include <cardiac/anatomy/idealised.hpp>
#include <polyaffine/mesh/tet_mesh.hpp>

namespace cardiac::app {

/// Tetrahedra between the ellipsoids, about size_mm long, with the labels of idealised.hpp on the boundary
/// and every boundary vertex on the exact surface. Throws InputError for a wrong shape or size, or when the
/// program was built without CGAL.
polyaffine::TetMesh mesh_truncated_ellipsoid(const TruncatedEllipsoid& shape, double size_mm);

}  // namespace cardiac::app
