#pragma once

#include <cstdint>
#include <functional>
#include <unordered_map>
#include <vector>

#include <polyaffine/core/archive_access.hpp>
#include <polyaffine/kinematics/basis.hpp>
#include <polyaffine/mesh/curved_edges.hpp>
#include <polyaffine/mesh/tet_mesh.hpp>
#include <polyaffine/rules/gauss.hpp>

namespace polyaffine {

/// The functions of one linear or quadratic element at a point; without memory of its own on the heap.
struct ElementSample {
  Eigen::Matrix<int, Eigen::Dynamic, 1, 0, 10, 1> functions;
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 10, 1> N;
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 10> gradient;  ///< ∇N_a, 1/mm

  /// Value and gradient (1/mm) of a scalar field given at the nodes, value of a vector field.
  double value(const Vector& nodal) const;
  Vec3 slope(const Vector& nodal) const;
  Vec3 value(const Points& nodal) const;
};

/// Linear (4-node) or quadratic (10-node) isoparametric tetrahedra. Quadratic nodes follow the vertices of
/// the mesh: one at the middle of each edge, in an element in the order 01, 12, 02, 03, 13, 23 (that of VTK).
class LagrangeBasis : public Basis {
 public:
  /// Quadratic edges pass through the given midpoints (see smooth_midpoints); where that would turn an
  /// element over its edges stay straight. Throws InputError when order is not 1 or 2.
  LagrangeBasis(const TetMesh& mesh, int order, const EdgeMidpoints& midpoints = {});

  int order() const { return order_; }
  const Points& nodes() const { return nodes_; }                 ///< mm
  const Eigen::MatrixXi& elements() const { return elements_; }  ///< 4 or 10 nodes a column

  int num_functions() const override { return static_cast<int>(nodes_.cols()); }
  BasisSample sample(int tet, const Vec4& barycentric) const override;
  ElementSample element_sample(int tet, const Vec4& barycentric) const;

  /// Barycentric coordinates of an element's nodes, 4 × (4 or 10).
  Eigen::Matrix4Xd node_barycentric() const;
  /// X = Σ N_a x_a, mm.
  Vec3 position(int tet, const Vec4& barycentric) const;
  Points positions(const std::vector<int>& tet, const Eigen::Matrix4Xd& barycentric) const;
  /// dX/dξ with ξ the last three barycentric coordinates; its determinant is six times the local volume.
  Mat3 jacobian(int tet, const Vec4& barycentric) const;
  /// Value of a scalar field given at the nodes.
  double interpolate(const Vector& nodal, int tet, const Vec4& barycentric) const;

  /// Gauss points exact to `degree` on straight elements, one block an element.
  WallPoints wall_points(int degree) const;
  /// The points of a rule of its own for each element.
  WallPoints wall_points(const std::function<TetRule(int tet)>& rule) const;
  /// Gauss points on the boundary faces with one of the labels, one block a face.
  SurfacePoints surface_points(const TetMesh& mesh, const std::vector<int>& labels, int degree) const;
  /// Corners of a face, barycentric in its tet.
  using FaceCorners = Eigen::Matrix<double, 4, 3>;
  /// The points of a rule of its own for each face, in barycentric coordinates of these corners.
  SurfacePoints surface_points(
      const TetMesh& mesh, const std::vector<int>& labels,
      const std::function<TriangleRule(int tet, const FaceCorners& corners)>& rule) const;
  /// Nodes on the boundary faces with one of the labels, sorted.
  std::vector<int> surface_nodes(const TetMesh& mesh, const std::vector<int>& labels) const;

 private:
  friend class ArchiveAccess;
  LagrangeBasis() = default;
  template <class Archive>
  void archive(Archive& a) {
    a(order_, nodes_, elements_);
    if constexpr (Archive::kReading)
      if (!is_whole())
        a.refuse("found finite elements whose order, nodes and elements do not fit each other");
  }
  bool is_whole() const;

  // Values of an element's functions and their derivatives by the barycentric coordinates, function by
  // column.
  struct Shape {
    Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 10, 1> N;
    Eigen::Matrix<double, 4, Eigen::Dynamic, 0, 4, 10> derivative;
  };
  Shape shape(const Vec4& barycentric) const;
  // ∂X/∂l, a column a barycentric coordinate.
  Eigen::Matrix<double, 3, 4> tangents(int tet, const Shape& shape) const;
  using EdgeNodes = std::unordered_map<std::uint64_t, int>;  // node of each edge
  EdgeNodes add_edge_nodes(const TetMesh& mesh);
  void straighten(int tet);
  bool turned_over(int tet) const;
  bool straighten_turned_over();

  int order_ = 1;
  Points nodes_;
  Eigen::MatrixXi elements_;
};

}  // namespace polyaffine
