#include "polyaffine/mesh/curved_edges.hpp"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>

namespace polyaffine {
namespace {

using Edge = std::pair<int, int>;

struct Bend {
  Vec3 offset, normal;
};

std::map<std::pair<int, int>, Vec3> vertex_normals(const TetMesh& mesh) {
  std::map<std::pair<int, int>, Vec3> normals;  // by label and vertex
  const auto& points = mesh.points();
  for (Eigen::Index f = 0; f < mesh.boundary().cols(); ++f) {
    const Eigen::Vector3i v = mesh.boundary().col(f);
    const Vec3 area =
        Vec3(points.col(v[1]) - points.col(v[0])).cross(Vec3(points.col(v[2]) - points.col(v[0])));
    for (int k = 0; k < 3; ++k) {
      const auto [it, first] = normals.try_emplace({mesh.boundary_labels()[f], v[k]}, area);
      if (!first) it->second += area;
    }
  }
  for (auto& [key, n] : normals) n.normalize();
  return normals;
}

// Where one or two surfaces bend an edge: the shortest offset that lies on all of them.
Vec3 combined(const std::vector<Bend>& bends) {
  if (bends.size() == 1) return bends.front().offset;
  Eigen::MatrixX3d normals(static_cast<Eigen::Index>(bends.size()), 3);
  Vector height(normals.rows());
  for (Eigen::Index k = 0; k < normals.rows(); ++k) {
    normals.row(k) = bends[k].normal.transpose();
    height[k] = bends[k].normal.dot(bends[k].offset);
  }
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixX3d> qr;
  qr.setThreshold(0.2);  // surfaces that meet at less than about 10° count as one
  return qr.compute(normals).solve(height);
}

}  // namespace

EdgeMidpoints smooth_midpoints(const TetMesh& mesh) {
  const auto normals = vertex_normals(mesh);
  const auto& points = mesh.points();
  std::map<Edge, std::map<int, Bend>> bends;
  for (Eigen::Index f = 0; f < mesh.boundary().cols(); ++f) {
    const int label = mesh.boundary_labels()[f];
    for (int k = 0; k < 3; ++k) {
      const Edge edge = std::minmax(mesh.boundary()(k, f), mesh.boundary()((k + 1) % 3, f));
      const Vec3 d = points.col(edge.second) - points.col(edge.first);
      const Vec3 na = normals.at({label, edge.first});
      const Vec3 nb = normals.at({label, edge.second});
      Vec3 offset = Vec3::Zero();
      if (label != TetMesh::kUnlabelled) offset = -(d.dot(na) * na - d.dot(nb) * nb) / 8;
      bends[edge][label] = {offset, (na + nb).normalized()};
    }
  }
  EdgeMidpoints out;
  for (const auto& [edge, by_label] : bends) {
    std::vector<Bend> all;
    for (const auto& [label, bend] : by_label) all.push_back(bend);
    out[edge] = 0.5 * (points.col(edge.first) + points.col(edge.second)) + combined(all);
  }
  return out;
}

}  // namespace polyaffine
