#pragma once

#include <vector>

#include <polyaffine/core/types.hpp>

namespace polyaffine {

/// The triangle of a surface that is nearest to each of the places (3 × n); not empty.
std::vector<int> nearest_triangles(const Points& points, const Triangles& triangles, const Points& places);

}  // namespace polyaffine
