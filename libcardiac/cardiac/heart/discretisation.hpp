#pragma once

#include <memory>
#include <vector>

#include <cardiac/anatomy/segment_frames.hpp>
#include <cardiac/protocol/protocol.hpp>
#include <polyaffine/energy/pressure_space.hpp>
#include <polyaffine/kinematics/basis.hpp>
#include <polyaffine/solve/linear_system.hpp>

namespace cardiac {

/// The mesh with its coordinates and segments: what every method starts from.
struct Anatomy {
  polyaffine::TetMesh mesh;
  SurfaceLabels labels;
  std::shared_ptr<const VentricularCoordinates> coordinates;
  std::vector<int> segment;  ///< AHA segment of each tet
};

/// Throws InputError as the mesh, its coordinates and its segments do.
Anatomy build_anatomy(polyaffine::TetMesh mesh, const Protocol& protocol);

/// Shape functions with their integration points: a full-order or a reduced model of the same wall.
struct Discretisation {
  std::shared_ptr<const polyaffine::Basis> basis;
  std::shared_ptr<const SegmentFrames> frames;  ///< null for full order
  polyaffine::WallPoints points;
  polyaffine::SurfacePoints
      cavity_points;  ///< endocardium, tangents turned so that X_ξ × X_η leaves the cavity
  polyaffine::SurfacePoints epicardium_points;  ///< empty unless a spring acts there
  std::vector<char> fixed;                      ///< unknowns held at zero
  int num_unknowns = 0;                         ///< that are not fixed
  bool sparse = false;
};

/// The reduced model: segment frames with the functions that the protocol's reduction names.
Discretisation reduced_discretisation(const Anatomy& anatomy, const Protocol& protocol);
/// Linear or quadratic finite elements on the whole mesh.
Discretisation full_discretisation(const Anatomy& anatomy, const Protocol& protocol);

/// The pressure space of a discretisation, over the points of its deformation table.
polyaffine::PressureSpace pressure_space(const Anatomy& anatomy, const Discretisation& discretisation,
                                         const polyaffine::FieldTable& table, const Protocol& protocol);

}  // namespace cardiac
