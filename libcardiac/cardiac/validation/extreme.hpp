#pragma once

#include <vector>

#include <cardiac/validation/check.hpp>

namespace cardiac {

/// Stiff and extreme scenes, reduced and full order: each completes within bounds, or stops and says why
/// where it may. Cases are called extreme/GROUP/SCENE; every check has the record of its run.
std::vector<Check> validate_extreme(const ValidationContext& context);

}  // namespace cardiac
