#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <cardiac/anatomy/heart_mesh.hpp>
#include <cardiac/protocol/build_anatomy.hpp>

namespace cardiac::app {

/// The heart on the mesh of a protocol, in mm: read from its file with its fibre fields, or the idealised
/// shape meshed. What was repaired or recognised in the file is added to the warnings. Throws InputError,
/// naming the mesh, and when this build lacks what it needs of VTK and CGAL.
HeartMesh load_heart(const Protocol& protocol, std::vector<std::string>& warnings,
                     const WallSizeRule& size = {});

/// The anatomy on a heart that was loaded for the protocol; what was assumed about how a mesh file lies is
/// added to the warnings. Throws InputError as build_anatomy, naming the mesh file.
Anatomy anatomy_of(const HeartMesh& heart, const Protocol& protocol, std::vector<std::string>& warnings);

/// Both, with the fibres of the mesh file where the protocol asks for them; those that a protocol with fibres
/// does not use are a warning. Throws InputError as FileFibres.
Anatomy load_anatomy(const Protocol& protocol, std::vector<std::string>& warnings);

/// A protocol file with its overrides, its heart on its mesh: a scheme that neither file nor shape
/// tells is that of the mesh; with the fibres of the mesh file where the protocol asks for them (those that a
/// protocol with fibres does not use are a warning). Throws InputError as load_protocol, load_heart,
/// anatomy_of and FileFibres.
Protocol load_input(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                    const WallSizeRule& size = {});

}  // namespace cardiac::app
