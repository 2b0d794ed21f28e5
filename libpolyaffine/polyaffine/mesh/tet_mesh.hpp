#pragma once

#include <vector>

#include <polyaffine/core/types.hpp>

namespace polyaffine {

/// Triangles of a surface with one integer label each, as a file brings them (any orientation and order).
struct LabelledTriangles {
  Triangles triangles;
  std::vector<int> labels;
};

/// Volume of a tet, det[x₁−x₀, x₂−x₀, x₃−x₀]/6, mm³.
double signed_volume(const Points& points, const Eigen::Vector4i& tet);

/// No volume to speak of: at most 1e-8 L³, L the longest edge (L³/8 in a good tet); below that the shape is
/// lost to rounding of file coordinates.
bool is_flat(const Points& points, const Eigen::Vector4i& tet);

/// An immutable tetrahedral mesh with region labels and a labelled boundary.
///
/// Points are mm. Every tet is positively oriented (construction swaps two vertices of a negative one only
/// when all tets are negative, that is when the file numbers them the other way round). The boundary holds
/// every face that belongs to one tet, oriented outwards, with the label of the given triangle on the same
/// three vertices, or kUnlabelled.
class TetMesh {
 public:
  static constexpr int kUnlabelled = 0;

  TetMesh() = default;
  /// Throws InputError when an index is out of range, a coordinate is not finite, a tet is flat or inverted
  /// against the others, a face is shared by more than two tets, a point is in no tet, the mesh falls into
  /// parts that share no face, or a labelled triangle is not on the boundary.
  TetMesh(Points points, Tets tets, std::vector<int> region = {}, const LabelledTriangles& surface = {});

  /// The same mesh with other labels, one for each boundary triangle.
  TetMesh with_labels(std::vector<int> labels) const;

  const Points& points() const { return points_; }
  const Tets& tets() const { return tets_; }
  const std::vector<int>& regions() const { return regions_; }  ///< a label per tet, 0 where none was given
  const Triangles& boundary() const { return boundary_; }
  const std::vector<int>& boundary_labels() const { return boundary_labels_; }
  const std::vector<int>& boundary_tets() const { return boundary_tets_; }  ///< the tet behind each face
  /// Tet across face k (opposite vertex k) of tet t, −1 on the boundary; 4 × tets.
  const Eigen::Matrix4Xi& neighbours() const { return neighbours_; }

  int num_points() const { return static_cast<int>(points_.cols()); }
  int num_tets() const { return static_cast<int>(tets_.cols()); }

  double tet_volume(int t) const;  ///< mm³
  Vec3 tet_centroid(int t) const;
  double volume() const;  ///< mm³
  /// Outward boundary triangles that carry one of the labels.
  Triangles surface(const std::vector<int>& labels) const;
  /// Sorted distinct vertices of those triangles.
  std::vector<int> surface_points(const std::vector<int>& labels) const;

 private:
  Points points_;
  Tets tets_;
  std::vector<int> regions_;
  Triangles boundary_;
  std::vector<int> boundary_labels_;
  std::vector<int> boundary_tets_;
  Eigen::Matrix4Xi neighbours_;
};

}  // namespace polyaffine
