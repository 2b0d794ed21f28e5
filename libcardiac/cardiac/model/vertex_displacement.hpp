#pragma once

#include <cardiac/model/ventricle.hpp>
#include <polyaffine/kinematics/field_table.hpp>

namespace cardiac {

/// A tet and corner for each vertex of a mesh; without weights and blocks.
polyaffine::WallPoints vertex_points(const polyaffine::TetMesh& mesh);

/// The displacement of every vertex of a mesh from the coefficients of functions on it, or of the wall.
polyaffine::DisplacementMap vertex_displacement(const polyaffine::TetMesh& mesh,
                                                const polyaffine::Basis& basis);
polyaffine::DisplacementMap vertex_displacement(const Ventricle& ventricle);

}  // namespace cardiac
