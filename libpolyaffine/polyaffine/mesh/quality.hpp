#pragma once

#include <array>

#include <polyaffine/mesh/tet_mesh.hpp>

namespace polyaffine {

/// Shape of the tets of a mesh.
struct MeshQuality {
  double min_dihedral_deg = 0;  ///< smallest and largest angle between two faces; 70.53° in a regular tet
  double max_dihedral_deg = 0;
  double max_aspect_ratio = 0;  ///< longest edge over shortest height, divided by √(3/2): 1 in a regular tet
  double mean_aspect_ratio = 0;
  double min_radius_ratio = 0;  ///< 3 × inscribed over circumscribed radius: 1 in a regular tet, 0 when flat
  double mean_radius_ratio = 0;
  double min_edge_mm = 0;
  double max_edge_mm = 0;
  double mean_edge_mm = 0;  ///< mean over the six edges of every tet
  double min_volume_mm3 = 0;
};

/// Measures of all tets (Shewchuk 2002, What is a good linear finite element?).
MeshQuality mesh_quality(const TetMesh& mesh);

/// The six angles between faces of one tet (a column a vertex), degrees.
std::array<double, 6> dihedral_angles_deg(const Eigen::Matrix<double, 3, 4>& tet);

/// Longest edge over shortest height, divided by √(3/2).
double aspect_ratio(const Eigen::Matrix<double, 3, 4>& tet);

/// 3 r_in / r_circ with r_in = 3V/ΣA and r_circ = √((p+q+r)(p+q−r)(p−q+r)(−p+q+r)) / (24V), p, q, r the
/// products of opposite edges.
double radius_ratio(const Eigen::Matrix<double, 3, 4>& tet);

}  // namespace polyaffine
