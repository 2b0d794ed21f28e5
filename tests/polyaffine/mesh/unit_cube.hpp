#pragma once

#include <polyaffine/mesh/tet_mesh.hpp>

namespace polyaffine::testing {

/// The unit cube (mm) in six tets around the diagonal 0–7; point i has the bits of i as x, y, z.
struct CubeParts {
  Points points;
  Tets tets;
};

inline CubeParts unit_cube() {
  CubeParts cube{Points(3, 8), Tets(4, 6)};
  for (int i = 0; i < 8; ++i) cube.points.col(i) = Vec3(i & 1, (i >> 1) & 1, (i >> 2) & 1);
  cube.tets << 0, 0, 0, 0, 0, 0,  //
      1, 3, 2, 6, 4, 5,           //
      3, 2, 6, 4, 5, 1,           //
      7, 7, 7, 7, 7, 7;
  return cube;
}

/// Label 1 on z = 0, label 2 on z = 1, nothing elsewhere.
inline LabelledTriangles cube_labels() {
  LabelledTriangles surface{Triangles(3, 4), {1, 1, 2, 2}};
  surface.triangles << 0, 0, 4, 4,  //
      1, 2, 5, 6,                   //
      3, 3, 7, 7;
  return surface;
}

}  // namespace polyaffine::testing
