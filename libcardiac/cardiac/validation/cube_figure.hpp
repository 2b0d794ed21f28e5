#pragma once

#include <string>

#include <cardiac/validation/cube_table.hpp>

namespace cardiac {

/// Tilt of the faces against the number of integration points: the paper's, region volumes as weights, and
/// consistent weights, for 5 and 9 zones.
std::string cube_svg(const CubeTable& table);

}  // namespace cardiac
