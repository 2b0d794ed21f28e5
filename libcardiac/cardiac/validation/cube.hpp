#pragma once

#include <vector>

#include <cardiac/validation/check.hpp>

namespace cardiac {

/// The cube of the poly-affine paper (Desrues, Delingette & Sermesant): its Table 1 with the error and tilt
/// that random sampling makes, what causes them and their cure; then the cube between no-slip platens against
/// quadratic tetrahedra. Writes cube.csv, cube.svg and platens.csv.
std::vector<Check> validate_cube(const ValidationContext& context);

}  // namespace cardiac
