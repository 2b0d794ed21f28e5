#pragma once

#include <string>
#include <vector>

#include <cardiac/anatomy/heart_mesh.hpp>
#include <cardiac/heart/discretisation.hpp>

namespace cardiac::app {

/// The heart on the mesh of a protocol, in mm: read from its file with its fibre fields, or the idealised
/// shape meshed. What was repaired or recognised in the file is added to the warnings. Throws InputError,
/// naming the mesh, and when this build lacks what it needs of VTK and CGAL.
HeartMesh load_heart(const Protocol& protocol, std::vector<std::string>& warnings);

/// The anatomy on a heart that was loaded for the protocol; what was assumed about how a mesh file lies is
/// added to the warnings. Throws InputError as build_anatomy, naming the mesh file.
Anatomy anatomy_of(const HeartMesh& heart, const Protocol& protocol, std::vector<std::string>& warnings);

/// Both, with the fibres of the file where the protocol asks for them; fibres of the file that a protocol
/// with fibres does not use are a warning. Throws InputError as FileFibres.
Anatomy load_anatomy(const Protocol& protocol, std::vector<std::string>& warnings);

}  // namespace cardiac::app
