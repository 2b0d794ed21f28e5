#pragma once

#include <vector>

#include <cardiac/validation/check.hpp>

namespace cardiac {

/// The truncated ellipsoid of the poly-affine paper (Desrues, Delingette, Sermesant, Fig. 5; see
/// EllipsoidProblem) by full order and by control frames in n_z rings of n_t and a cap, from 2 × 3 to 6 × 12.
/// Writes ellipsoid.csv, a row a model, ellipsoid_profile.csv, the outer meridian, ellipsoid_base.csv, a row
/// for each way of holding the base, and ellipsoid.svg. Errors are relative L2 displacement errors against
/// quadratic elements on a fine structured mesh; those of quadratic elements on the models' own mesh are told
/// too.
std::vector<Check> validate_ellipsoid(const ValidationContext& context);

}  // namespace cardiac
