#pragma once

#include <array>
#include <limits>
#include <vector>

#include <polyaffine/core/types.hpp>
#include <polyaffine/mesh/tet_mesh.hpp>

namespace cardiac {

/// A point of the mesh on the edge from vertex `from` to vertex `to`: x = (1 − share) x_from + share x_to. It
/// moves with the material.
struct EdgePoint {
  int from = 0, to = 0;
  double share = 0;
};

/// A surface of material points: triangles whose corners lie on edges of the mesh.
struct MaterialSheet {
  std::vector<EdgePoint> points;
  std::vector<std::array<int, 3>> triangles;

  /// Positions of the points from those of the vertices, 3 × points, mm.
  polyaffine::Points positions(const polyaffine::Points& x) const;
  /// mm², from positions().
  double area(const polyaffine::Points& positions) const;
};

/// The triangles of the boundary with the given numbers.
MaterialSheet boundary_sheet(const polyaffine::TetMesh& mesh, const std::vector<int>& faces);

/// Where a field given at the vertices, linear in each tet, has the value `level`, in the tets with the given
/// numbers.
MaterialSheet level_sheet(const polyaffine::TetMesh& mesh, const std::vector<int>& tets,
                          const polyaffine::Vector& field, double level);

/// A material line on a sheet: pieces between points of the sheet's edges.
struct MaterialLine {
  std::vector<std::array<EdgePoint, 2>> pieces;  ///< the edges are those between points of the sheet

  /// mm, from the positions of the sheet's points; 0 of an empty line.
  double length(const polyaffine::Points& positions) const;
};

/// Where a field given at the vertices of the mesh, linear along the sheet's triangles, is zero. Triangles
/// across which the field changes by more than `largest_jump` are left out (an angle that wraps round).
MaterialLine zero_line(const MaterialSheet& sheet, const polyaffine::Vector& field,
                       double largest_jump = std::numeric_limits<double>::infinity());

}  // namespace cardiac
