#pragma once

#include <map>
#include <vector>

#include <cardiac/anatomy/idealised.hpp>
#include <cardiac/anatomy/structured_ellipsoid.hpp>
#include <polyaffine/mesh/surface.hpp>

#include "support/mesh_writers.hpp"

/// Small hearts with what other tools put into their files, for tests only.
namespace testing_io {

/// A coarse human left ventricle; the triangle field "physical" is 1 endocardium, 2 epicardium, 3 base.
inline const polyaffine::TetMesh& ventricle() {
  static const polyaffine::TetMesh mesh =
      cardiac::structured_ellipsoid(cardiac::human_lv(), {10, 16, 2}).mesh;
  return mesh;
}

inline MeshData ventricle_data() {
  return data_of(ventricle());
}

inline int add_point(MeshData& mesh, const polyaffine::Vec3& x) {
  const Eigen::Index n = mesh.points.cols();
  mesh.points.conservativeResize(3, n + 1);
  mesh.points.col(n) = x;
  return static_cast<int>(n);
}

inline void add_triangle(MeshData& mesh, const Eigen::Vector3i& corners, double label) {
  const Eigen::Index n = mesh.triangles.cols();
  mesh.triangles.conservativeResize(3, n + 1);
  mesh.triangles.col(n) = corners;
  polyaffine::Matrix& field = mesh.triangle_fields["physical"];
  field.conservativeResize(1, n + 1);
  field(0, n) = label;
}

inline std::vector<int> endocardial_rim() {
  return polyaffine::rim_loops(ventricle().surface({cardiac::kEndocardium})).front();
}

/// A lid over the mitral opening under the label 5, about a point of its own or about a point of the rim.
inline MeshData with_cap(bool own_point) {
  MeshData mesh = ventricle_data();
  const std::vector<int> rim = endocardial_rim();
  const polyaffine::Vec3 centre = mesh.points(Eigen::all, rim).rowwise().mean();
  const int c = own_point ? add_point(mesh, centre) : rim.front();
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const int a = rim[i], b = rim[(i + 1) % rim.size()];
    if (a != c && b != c) add_triangle(mesh, {c, a, b}, 5);
  }
  return mesh;
}

/// The triangles of the endocardium a second time under the label 6, as the surface of the cavity.
inline MeshData with_repetition() {
  MeshData mesh = ventricle_data();
  const Eigen::Index n = mesh.triangles.cols();
  for (Eigen::Index t = 0; t < n; ++t)
    if (mesh.triangle_fields["physical"](0, t) == 1) add_triangle(mesh, mesh.triangles.col(t), 6);
  return mesh;
}

/// Wall (region 1, "myocardium") and blood (region 2, "blood") as tets; the endocardium lies between them.
inline MeshData with_blood() {
  MeshData mesh = ventricle_data();
  const std::vector<int> rim = endocardial_rim();
  const polyaffine::Triangles endo = ventricle().surface({cardiac::kEndocardium});
  const int lid = add_point(mesh, mesh.points(Eigen::all, rim).rowwise().mean());
  const int centre = add_point(mesh, polyaffine::Vec3(0, 0, mesh.points(2, lid) - 20));
  const Eigen::Index wall = mesh.tets.cols();
  polyaffine::CellList blood{4};
  for (const auto& t : endo.colwise()) blood.add(std::array{centre, t[0], t[1], t[2]});
  for (std::size_t i = 0; i < rim.size(); ++i)
    blood.add(std::array{centre, lid, rim[i], rim[(i + 1) % rim.size()]});
  mesh.tets.conservativeResize(4, wall + blood.size());
  mesh.tets.rightCols(blood.size()) = blood.matrix();
  for (Eigen::Index t = wall; t < mesh.tets.cols(); ++t)
    if (polyaffine::signed_volume(mesh.points, mesh.tets.col(t)) < 0)
      std::swap(mesh.tets(2, t), mesh.tets(3, t));
  mesh.tet_fields["region"] = polyaffine::Matrix::Constant(1, mesh.tets.cols(), 1);
  mesh.tet_fields["region"].rightCols(blood.size()).setConstant(2);
  mesh.region_names = {{1, "myocardium"}, {2, "blood"}};
  mesh.surface_names = {{1, "endo"}, {2, "epi"}, {3, "base"}};
  return mesh;
}

/// Labels of points under Cobiveco's numbers and name: 1 base, 2 epicardium, 3 endocardium.
inline MeshData with_labels_of_points() {
  MeshData mesh = ventricle_data();
  polyaffine::Matrix& label = mesh.point_fields["class"] = polyaffine::Matrix::Zero(1, mesh.points.cols());
  for (const auto& [surface, number] : {std::pair{1, 3}, {2, 2}, {3, 1}})
    for (const int p : ventricle().surface_points({surface})) label(0, p) = number;
  mesh.triangle_fields.clear();
  return mesh;
}

/// One surface alone, without a label.
inline MeshData surface_alone(int label) {
  MeshData mesh = ventricle_data();
  mesh.tets.resize(4, 0);
  mesh.triangles = ventricle().surface({label});
  mesh.triangle_fields.clear();
  return mesh;
}

}  // namespace testing_io
