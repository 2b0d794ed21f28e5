#pragma once

#include <vector>

#include <polyaffine/core/types.hpp>

namespace cardiac {

/// Checks the labels of the boundary of a heart (outward triangles with one of kEndocardium, kEpicardium,
/// kBase, kRvEndocardium or none each; points in mm). Throws InputError when a labelled endocardium surrounds
/// no cavity, has no rim, or one off the base (as check_bare_rings where it is shared with the epicardium),
/// or when the epicardium does not surround the cavities: as when labels are swapped.
void check_heart_surfaces(const polyaffine::Points& points, const polyaffine::Triangles& boundary,
                          const std::vector<int>& labels);

}  // namespace cardiac
