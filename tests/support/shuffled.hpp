#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

#include <polyaffine/mesh/tet_mesh.hpp>

/// The same body in another place, with vertices and tets in another order and tets numbered from another
/// vertex; region, labels and optional vectors of the tets go along.
inline polyaffine::TetMesh shuffled(const polyaffine::TetMesh& mesh, const polyaffine::Mat3& rotation,
                                    const polyaffine::Vec3& shift, polyaffine::Matrix* of_tets = nullptr) {
  std::mt19937 random(1);
  std::vector<int> vertex(mesh.num_points()), tet(mesh.num_tets());
  std::iota(vertex.begin(), vertex.end(), 0);
  std::iota(tet.begin(), tet.end(), 0);
  std::ranges::shuffle(vertex, random);
  std::ranges::shuffle(tet, random);
  polyaffine::Points points(3, mesh.num_points());
  for (int i = 0; i < mesh.num_points(); ++i) points.col(vertex[i]) = rotation * mesh.points().col(i) + shift;
  polyaffine::Tets tets(4, mesh.num_tets());
  std::vector<int> regions;
  for (int t = 0; t < mesh.num_tets(); ++t) {
    for (int k = 0; k < 4; ++k) tets(k, t) = vertex[mesh.tets()(k, tet[t])];
    // An even permutation keeps the orientation.
    std::rotate(tets.col(t).begin(), tets.col(t).begin() + t % 3, tets.col(t).begin() + 3);
    regions.push_back(mesh.regions()[tet[t]]);
  }
  polyaffine::LabelledTriangles surface{mesh.boundary(), mesh.boundary_labels()};
  for (int& p : surface.triangles.reshaped()) p = vertex[p];
  if (of_tets != nullptr) *of_tets = polyaffine::Matrix((*of_tets)(Eigen::all, tet));
  return {points, tets, regions, surface};
}

inline polyaffine::Mat3 a_rotation() {
  return Eigen::AngleAxisd(1.1, polyaffine::Vec3(1, -2, 0.7).normalized()).toRotationMatrix();
}
