#pragma once

#include <string>
#include <vector>

#include <cardiac/heart/discretisation.hpp>

namespace cardiac::app {

/// The anatomy on the mesh of a protocol, in mm: read from its file, or the idealised shape meshed. What was
/// repaired or recognised in the file is added to the warnings. Throws InputError as they do, naming the
/// mesh, and when this build lacks VTK or CGAL.
Anatomy load_anatomy(const Protocol& protocol, std::vector<std::string>& warnings);

}  // namespace cardiac::app
