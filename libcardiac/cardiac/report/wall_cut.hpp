#pragma once

#include <vector>

#include <polyaffine/mesh/tet_mesh.hpp>

namespace cardiac {

/// What is seen of a tetrahedral mesh that is cut open by a plane: its outer surface behind the plane and the
/// section, as polygons whose corners lie on vertices and edges of the mesh, so that they follow it when it
/// deforms.
struct WallCut {
  struct Corner {
    int from = 0, to = 0;  ///< vertices of the mesh; the same where the corner is a vertex
    double share = 0;      ///< of the way from `from` to `to`
  };
  struct Face {
    std::vector<int> corners;  ///< counter-clockwise seen from outside of what is left
    int tet = 0;               ///< that it belongs to
    bool section = false;
  };
  std::vector<Corner> corners;
  std::vector<Face> faces;

  /// Corners of the deformed mesh, 3 × corners; `points` are its vertices, 3 × n.
  polyaffine::Points positions(const polyaffine::Points& points) const;
};

/// Cuts away the part of the mesh with (X − origin)·normal > 0, in the reference configuration. Empty when
/// nothing is left.
WallCut cut_wall(const polyaffine::TetMesh& mesh, const polyaffine::Vec3& origin,
                 const polyaffine::Vec3& normal);

}  // namespace cardiac
