#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "polyaffine/geometry/box_mesh.hpp"

namespace polyaffine::testing {

/// Labels of the faces of a box.
enum BoxFace { kXLow = 1, kXHigh, kYLow, kYHigh, kZLow, kZHigh };

/// box_mesh with its six faces labelled (BoxFace).
inline TetMesh labelled_box(const Vec3& low, const Vec3& high, const Eigen::Vector3i& n, double jitter = 0) {
  const TetMesh plain = box_mesh(low, high, n, jitter);
  LabelledTriangles surface{plain.boundary(), {}};
  for (Eigen::Index f = 0; f < surface.triangles.cols(); ++f) {
    const auto corners = plain.points()(Eigen::all, surface.triangles.col(f));
    for (int d = 0; d < 3; ++d) {
      const double tolerance = 1e-9 * (high[d] - low[d]);
      if ((corners.row(d).array() - low[d]).abs().maxCoeff() < tolerance)
        surface.labels.push_back(2 * d + 1);
      else if ((corners.row(d).array() - high[d]).abs().maxCoeff() < tolerance)
        surface.labels.push_back(2 * d + 2);
    }
  }
  return TetMesh(plain.points(), plain.tets(), {}, surface);
}

inline TetMesh labelled_cube(int n, double jitter = 0) {
  return labelled_box(Vec3::Zero(), Vec3::Ones(), Eigen::Vector3i::Constant(n), jitter);
}

/// The mesh with its points moved; labels stay.
template <class Map>
TetMesh mapped(const TetMesh& mesh, const Map& map) {
  Points points = mesh.points();
  for (Eigen::Index i = 0; i < points.cols(); ++i) points.col(i) = map(Vec3(points.col(i)));
  return TetMesh(points, mesh.tets(), mesh.regions(), {mesh.boundary(), mesh.boundary_labels()});
}

/// From (r, y, z), y and z in [0, 1], to a quarter of a face of the cubed sphere of radius r: the planes y =
/// 0, z = 0, y = x and z = x bound it.
inline Vec3 to_sphere(const Vec3& ryz) {
  return ryz.x() * Vec3(1, ryz.y(), ryz.z()).normalized();
}

}  // namespace polyaffine::testing
