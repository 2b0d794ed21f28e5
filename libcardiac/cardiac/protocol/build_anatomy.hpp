#pragma once

#include <optional>

#include <cardiac/anatomy/idealised.hpp>
#include <cardiac/protocol/protocol.hpp>

namespace cardiac {

/// What is known of a wall beyond its mesh.
struct ExactGeometry {
  std::optional<polyaffine::EdgeMidpoints> midpoints;  ///< absent: smooth_midpoints of the mesh
  FibreFunction fibres;                                ///< see Anatomy
};

/// The left ventricle that mesh.shape names, human_lv with its scales, in mm; not for human_biventricle.
TruncatedEllipsoid ellipsoid_of(const protocol::Mesh& mesh);

/// The boundary of the mesh carries the labels kEndocardium, kEpicardium and kBase, with two ventricles also
/// kRvEndocardium. Throws InputError as its coordinates and its segments do, and when the protocol's scheme
/// is for another number of ventricles.
Anatomy build_anatomy(polyaffine::TetMesh mesh, const Protocol& protocol, const ExactGeometry& exact = {});

}  // namespace cardiac
