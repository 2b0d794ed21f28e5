#pragma once

#include <cardiac/heart/ventricle.hpp>
#include <polyaffine/kinematics/field_table.hpp>

namespace cardiac::app {

/// The displacement of every vertex of the mesh from the coefficients of the wall.
polyaffine::DisplacementMap vertex_displacement(const Ventricle& ventricle);

}  // namespace cardiac::app
