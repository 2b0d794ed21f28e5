#pragma once

#include <CLI/CLI.hpp>

namespace cardiac::app {

/// `import` under the command `mesh`: meshes of other tools, or closed surfaces, as labelled tetrahedra.
void add_import_command(CLI::App& mesh);

}  // namespace cardiac::app
