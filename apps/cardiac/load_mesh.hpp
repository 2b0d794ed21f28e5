#pragma once

#include <cardiac/protocol/protocol.hpp>
#include <polyaffine/mesh/tet_mesh.hpp>

namespace cardiac::app {

/// The mesh of a protocol in mm: read from its file, or the idealised shape meshed. Throws InputError as they
/// do, and when this build lacks VTK or CGAL.
polyaffine::TetMesh load_mesh(const Protocol& protocol);

}  // namespace cardiac::app
