#pragma once

#include <vector>

#include <cardiac/anatomy/coordinates.hpp>

namespace cardiac {

/// Strain and directions in each tet of a mesh whose vertices move, the deformation gradient F being constant
/// in a tet.
class TetGauge {
 public:
  /// `x_ed`: end-diastolic positions of the vertices, mm.
  TetGauge(const polyaffine::TetMesh& mesh, const VentricularCoordinates& coordinates,
           const polyaffine::Points& x_ed);

  /// Normal strains (L − L₀)/L₀ along the local axes (longitudinal, circumferential, radial) of the tet's
  /// centre, turned with its end-diastolic rotation, against end diastole; as SegmentGauge. 3 × tets.
  polyaffine::Points strain(const polyaffine::Points& x) const;

  /// Directions f of the mesh carried along: F f / |F f|, 3 × tets.
  polyaffine::Points turned(const polyaffine::Points& directions, const polyaffine::Points& x) const;

 private:
  polyaffine::Mat3 edges(int tet, const polyaffine::Points& x) const;

  polyaffine::Tets tets_;
  std::vector<polyaffine::Mat3> from_mesh_;  ///< inverse edges in the mesh
  std::vector<polyaffine::Mat3> from_axes_;  ///< edges now times this: the local axes deformed
};

}  // namespace cardiac
