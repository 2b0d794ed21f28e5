#pragma once

#include <cardiac/anatomy/idealised_biventricle.hpp>
#include <polyaffine/mesh/tet_mesh.hpp>

namespace cardiac::app {

/// A mesh of the shape with edges of about size_mm, boundary labels kEndocardium, kEpicardium, kBase and
/// kRvEndocardium and regions kLvWall, kRvWall and kSeptum. Throws InputError for a size that is not positive
/// or twice the right wall or more, ComputationError when a dihedral angle stays below 8°.
polyaffine::TetMesh mesh_biventricle(const IdealisedBiventricle& shape, double size_mm);

}  // namespace cardiac::app
