#pragma once

#include <string>
#include <vector>

#include <cardiac/anatomy/coordinates.hpp>
#include <cardiac/report/colour_map.hpp>

namespace cardiac {

/// Colour of AHA segment 1–29: hues go round each ventricle, lighter towards the apex.
Rgb segment_colour(int segment);

/// The AHA segments of a wall (of each tet) with their numbers, as SVG: seen from the anterior and from the
/// inferior side, and cut across at half the height of the left cavity, seen from the apex as a bull's-eye
/// is.
std::string segment_picture_svg(const polyaffine::TetMesh& mesh, const VentricularCoordinates& coordinates,
                                const std::vector<int>& segment);

}  // namespace cardiac
