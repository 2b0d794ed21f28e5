#pragma once

#include <polyaffine/mesh/curved_edges.hpp>
#include <polyaffine/mesh/tet_mesh.hpp>

namespace polyaffine::testing {

/// Exact midpoints of all edges of a mesh between spheres about the origin: mean radius, mean direction.
inline EdgeMidpoints sphere_midpoints(const TetMesh& mesh) {
  EdgeMidpoints out;
  for (int t = 0; t < mesh.num_tets(); ++t)
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < 4; ++b) {
        const int i = mesh.tets()(a, t);
        const int j = mesh.tets()(b, t);
        if (i >= j) continue;
        const Vec3 x = mesh.points().col(i);
        const Vec3 y = mesh.points().col(j);
        out[{i, j}] = (x.norm() + y.norm()) / 2 * (x + y).normalized();
      }
  return out;
}

}  // namespace polyaffine::testing
