#include "polyaffine/mesh/quality.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace polyaffine {
namespace {

using TetPoints = Eigen::Matrix<double, 3, 4>;

constexpr std::array<std::array<int, 2>, 6> kEdges{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

std::array<double, 6> edge_lengths(const TetPoints& x) {
  std::array<double, 6> lengths{};
  for (int e = 0; e < 6; ++e) lengths[e] = (x.col(kEdges[e][1]) - x.col(kEdges[e][0])).norm();
  return lengths;
}

double volume(const TetPoints& x) {
  return std::abs((x.col(1) - x.col(0)).dot((x.col(2) - x.col(0)).cross(x.col(3) - x.col(0)))) / 6;
}

/// Outward area vectors of the faces opposite each vertex, for a positive tet.
TetPoints area_vectors(const TetPoints& x) {
  TetPoints area;
  area.col(0) = (x.col(2) - x.col(1)).cross(x.col(3) - x.col(1)) / 2;
  area.col(1) = (x.col(3) - x.col(0)).cross(x.col(2) - x.col(0)) / 2;
  area.col(2) = (x.col(1) - x.col(0)).cross(x.col(3) - x.col(0)) / 2;
  area.col(3) = (x.col(2) - x.col(0)).cross(x.col(1) - x.col(0)) / 2;
  return area;
}

}  // namespace

std::array<double, 6> dihedral_angles_deg(const TetPoints& x) {
  const TetPoints area = area_vectors(x);
  std::array<double, 6> angles{};
  for (int e = 0; e < 6; ++e) {
    const Vec3 a = area.col(kEdges[e][0]), b = area.col(kEdges[e][1]);
    angles[e] = 180 / kPi * std::atan2(a.cross(b).norm(), -a.dot(b));
  }
  return angles;
}

double aspect_ratio(const TetPoints& x) {
  const auto lengths = edge_lengths(x);
  const double largest_face = area_vectors(x).colwise().norm().maxCoeff();
  const double shortest_height = 3 * volume(x) / largest_face;
  return *std::max_element(lengths.begin(), lengths.end()) / (shortest_height * std::sqrt(1.5));
}

double radius_ratio(const TetPoints& x) {
  const auto l = edge_lengths(x);
  const double p = l[0] * l[5], q = l[1] * l[4], r = l[2] * l[3];  // products of opposite edges
  const double square = (p + q + r) * (p + q - r) * (p - q + r) * (-p + q + r);
  if (square <= 0) return 0;
  const double v = volume(x);
  const double inscribed = 3 * v / area_vectors(x).colwise().norm().sum();
  const double circumscribed = std::sqrt(square) / (24 * v);
  return 3 * inscribed / circumscribed;
}

MeshQuality mesh_quality(const TetMesh& mesh) {
  MeshQuality q;
  const double infinity = std::numeric_limits<double>::infinity();
  q.min_dihedral_deg = q.min_radius_ratio = q.min_edge_mm = q.min_volume_mm3 = infinity;
  for (int t = 0; t < mesh.num_tets(); ++t) {
    const TetPoints x = mesh.points()(Eigen::all, mesh.tets().col(t));
    for (const double angle : dihedral_angles_deg(x)) {
      q.min_dihedral_deg = std::min(q.min_dihedral_deg, angle);
      q.max_dihedral_deg = std::max(q.max_dihedral_deg, angle);
    }
    for (const double length : edge_lengths(x)) {
      q.min_edge_mm = std::min(q.min_edge_mm, length);
      q.max_edge_mm = std::max(q.max_edge_mm, length);
      q.mean_edge_mm += length / (6.0 * mesh.num_tets());
    }
    const double aspect = aspect_ratio(x), radii = radius_ratio(x);
    q.max_aspect_ratio = std::max(q.max_aspect_ratio, aspect);
    q.mean_aspect_ratio += aspect / mesh.num_tets();
    q.min_radius_ratio = std::min(q.min_radius_ratio, radii);
    q.mean_radius_ratio += radii / mesh.num_tets();
    q.min_volume_mm3 = std::min(q.min_volume_mm3, mesh.tet_volume(t));
  }
  return q;
}

}  // namespace polyaffine
