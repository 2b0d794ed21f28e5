#pragma once

#include <CLI/CLI.hpp>

namespace cardiac::app {

/// `cardiac segment`: ventricular coordinates, AHA segments, control nodes and fibres of a mesh as fields.
void add_segment_command(CLI::App& app);

}  // namespace cardiac::app
