#pragma once

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

 private:
  std::optional<DirectionField> fibre_, sheet_, normal_;
  std::string description_;
  double ambiguous_share_ = 0;
};

/// Has the file a field "fibre"?
bool has_fibres(const polyaffine::MeshFile& file);

}  // namespace cardiac
