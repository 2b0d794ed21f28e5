#pragma once

#include <string>
#include <vector>

#include <cardiac/anatomy/coordinates.hpp>

namespace cardiac {

/// Is the wall a body of revolution about the z axis, as an idealised ventricle is? Then no direction across
/// the axis is more anterior than another.
///
/// Each of endocardium, epicardium and base: |∫ r e^{ikφ} dA| < .02 ∫ r dA for k = 1, 2, 3, with the polar
/// coordinates r, φ about z (off the axis, oval, triangular).
bool turned_about_z(const polyaffine::TetMesh& mesh, const SurfaceLabels& labels);

/// How the coordinates of a ventricle lie, in words, for a report: long axis and anterior direction.
std::vector<std::string> orientation_notes(const VentricularCoordinates& coordinates);

/// What was assumed about it and may be wrong: an oblique long axis, an anterior direction that nothing told
/// (of a left ventricle that is no body of revolution about z).
std::vector<std::string> orientation_warnings(const polyaffine::TetMesh& mesh, const SurfaceLabels& labels,
                                              const VentricularCoordinates& coordinates);

}  // namespace cardiac
