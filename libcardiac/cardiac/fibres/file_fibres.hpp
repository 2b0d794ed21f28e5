#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include <cardiac/anatomy/coordinates.hpp>
#include <cardiac/fibres/direction_field.hpp>
#include <cardiac/tissue/fibre_axes.hpp>
#include <polyaffine/mesh_io/assemble.hpp>

namespace cardiac {

/// The fibres that a mesh file brings: the fields "fibre", "sheet" and "sheet_normal" of a heart mesh, of
/// points or of tets (those of tets, which see more of a wall a few tets thick, where there are both). At a
/// point of the wall
/// - f is the direction of the fibres there (DirectionField: signs do not count; usual are circumferential
///   fibres and radial sheets),
/// - s is that of the sheets, across f; without them n × f with n that of the sheet normals; without these,
///   and where they are along f, the radial axis across f,
/// - n = f × s.
class FileFibres {
 public:
  /// `source` names the file in messages. Throws InputError, naming file, field and place, when there is no
  /// field "fibre" (saying which fields there are and their sizes) or a sheet or sheet normal is less than a
  /// degree off its fibre.
  FileFibres(const polyaffine::MeshFile& file, const std::string& source);

  /// Orthonormal f, s, n at points of the mesh.
  FibreAxes at(const VentricularCoordinates& coordinates, const std::vector<int>& tet,
               const Eigen::Matrix4Xd& barycentric) const;
  /// What of the file is used, such as "fibre of points, sheet across the wall".
  const std::string& description() const { return description_; }
  /// See DirectionField::ambiguous_share.
  double ambiguous_share() const { return ambiguous_share_; }
  Eigen::Index num_tets() const { return fibre_->num_tets(); }

  /// The same fibres when the vertices of their mesh move to `points` (mm): F f, F s and F⁻ᵀ n with the
  /// gradient F of the motion in a tet, at a vertex its mean over the tets about it.
  FileFibres moved(const polyaffine::TetMesh& mesh, const polyaffine::Points& points) const;
  /// The fields that are used, by their names "fibre", "sheet" and "sheet_normal".
  std::map<std::string, const DirectionField*> fields() const;

 private:
  friend class polyaffine::ArchiveAccess;
  FileFibres() = default;
  template <class Archive>
  void archive(Archive& a) {
    a(fibre_, sheet_, normal_, description_, ambiguous_share_);
    if constexpr (Archive::kReading)
      if (!is_whole()) a.refuse("found fibres whose fields do not fit each other");
  }
  bool is_whole() const;

  std::optional<DirectionField> fibre_, sheet_, normal_;
  std::string description_;
  double ambiguous_share_ = 0;
};

/// Fibres of a file as Anatomy holds them (FibreFunction), which an archive of the anatomy knows again.
struct FileFibreFunction {
  std::shared_ptr<const FileFibres> fibres;

  FibreAxes operator()(const VentricularCoordinates& coordinates, const std::vector<int>& tet,
                       const Eigen::Matrix4Xd& barycentric) const {
    return fibres->at(coordinates, tet, barycentric);
  }
};

/// Has the file a field "fibre"?
bool has_fibres(const polyaffine::MeshFile& file);

}  // namespace cardiac
