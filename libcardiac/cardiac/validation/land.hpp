#pragma once

#include <cardiac/validation/check.hpp>

namespace cardiac {

/// The three problems of Land et al. 2015 (Proc. R. Soc. A 471, 20150641), full order on two meshes each (the
/// coarse one only when quick): positions and volumes against the published ones, Newton iterations of the
/// load path and CPU time. Writes the convergence table land.csv.
std::vector<Check> validate_land(const ValidationContext& context);

}  // namespace cardiac
