#pragma once

#include <array>
#include <functional>
#include <vector>

#include <polyaffine/mesh/tet_mesh.hpp>

namespace polyaffine {

/// A solid given by a function, to be filled with tetrahedra. Lengths in mm.
struct ImplicitDomain {
  std::function<double(const Vec3&)> value;  ///< negative inside the solid
  Vec3 centre = Vec3::Zero();                ///< of a sphere that contains the solid
  double radius_mm = 0;                      ///< of that sphere
  std::vector<Points> edges;  ///< sharp edges, kept exactly; a closed one repeats its first point
  /// Moves a boundary vertex onto the exact surface; empty: vertices stay where the mesher put them.
  std::function<Vec3(const Vec3&)> project;
  /// Label of a boundary triangle with these (projected) vertices; empty: the boundary stays unlabelled.
  std::function<int(const std::array<Vec3, 3>&)> label;
};

struct MeshSizes {
  double cell_mm = 0;            ///< largest circumradius of a tet
  double facet_mm = 0;           ///< largest surface Delaunay ball of a boundary triangle
  double facet_distance_mm = 0;  ///< largest distance between a boundary triangle and the surface
  double edge_mm = 0;            ///< largest length of a segment of a sharp edge
  double min_dihedral_deg = 15;  ///< aim of the improvement
};

/// Sizes for tets with edges of about edge_mm: a regular tet of edge h has the circumradius .61 h, a regular
/// triangle .58 h.
inline MeshSizes sizes_for_edge(double edge_mm) {
  return {0.75 * edge_mm, 0.7 * edge_mm, 0.1 * edge_mm, edge_mm};
}

/// Delaunay refinement (CGAL Mesh_3), then ODT smoothing and perturbation until the dihedral angles reach
/// the aim or nothing more can be gained (Jamin, Alliez, Yvinec, Boissonnat 2015, ACM TOMS 41(4):23).
///
/// Deterministic: the random numbers start from a fixed seed. Throws InputError for a size that is not
/// positive or a solid without a surface in its sphere, ComputationError when no valid mesh comes out.
TetMesh mesh_implicit_domain(const ImplicitDomain& domain, const MeshSizes& sizes);

}  // namespace polyaffine
