#pragma once

#include <vector>

#include <polyaffine/core/archive_access.hpp>
#include <polyaffine/mesh/tet_mesh.hpp>

namespace cardiac {

/// A field of directions without sign on a mesh.
///
/// Given at the vertices, a direction in between is the principal one of the structure tensors v vᵀ, linear
/// between the vertices of the tet. Where two of these are more than 40° apart, which way the direction turns
/// is not known: it is taken to turn by way of a usual direction, of which each vector is given the sign, and
/// the vectors are averaged. Given one a tet, it holds at the centroid and turns from there at the
/// rate at which it turns, the shorter way, to the tets next to it and next but one (least squares by
/// volume).
class DirectionField {
 public:
  /// `vectors` is 3 × points, or 3 × tets with `of_tets`, of any length but none. Throws InputError naming
  /// the counts for another size.
  DirectionField(const polyaffine::TetMesh& mesh, const polyaffine::Matrix& vectors, bool of_tets);

  /// Unit vector, of either sign, at a point of the mesh.
  polyaffine::Vec3 at(int tet, const polyaffine::Vec4& barycentric, const polyaffine::Vec3& usual) const;
  /// Share of the tets in which two vectors of vertices are more than 40° apart; 0 for a field of tets.
  double ambiguous_share() const;
  Eigen::Index num_tets() const { return tets_.cols(); }
  bool of_tets() const { return !turning_.empty(); }
  /// The unit vectors as they were given, one a vertex or tet.
  const polyaffine::Points& vectors() const { return given_; }

 private:
  friend class polyaffine::ArchiveAccess;
  DirectionField() = default;
  template <class Archive>
  void archive(Archive& a) {
    a(points_, tets_, given_, turning_);
    if constexpr (Archive::kReading)
      if (!is_whole()) a.refuse("found a field of directions that does not fit its mesh");
  }
  bool is_whole() const;

  bool ambiguous(int tet) const;
  void find_turning(const polyaffine::TetMesh& mesh);

  polyaffine::Points points_;
  polyaffine::Tets tets_;
  polyaffine::Points given_;               // unit vectors
  std::vector<polyaffine::Mat3> turning_;  // of a field of tets: change of the vector by mm, across it
};

}  // namespace cardiac
