#pragma once

#include <polyaffine/mesh/tet_mesh.hpp>

namespace cardiac::app {

/// Unstructured tetrahedra of about edge_mm in the box [0, size]; its faces carry the labels 1 to 6: x = 0,
/// x = size, y = 0, y = size, z = 0, z = size. Throws InputError for a size that is not positive, or when the
/// program was built without CGAL.
polyaffine::TetMesh mesh_box(const polyaffine::Vec3& size_mm, double edge_mm);

}  // namespace cardiac::app
