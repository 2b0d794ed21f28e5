#pragma once

#include <array>
#include <string>
#include <vector>

#include <polyaffine/core/types.hpp>

namespace cardiac {

/// Edges (two vertices each) in which an endocardium and the outside of the wall meet without a base between
/// them: the wall tapers to them and has no thickness there.
using RingEdges = std::vector<std::array<int, 2>>;

/// What is wrong with the longest connected run of such edges, with its length, the mean of its points and
/// one of them (mm), and what to do; points in mm.
std::string bare_ring_text(const polyaffine::Points& points, const RingEdges& edges);

/// Throws InputError with that text when endocardium and epicardium of a labelled boundary (labels as of
/// check_heart_surfaces) share edges that do not lie on the base.
void check_bare_rings(const polyaffine::Points& points, const polyaffine::Triangles& boundary,
                      const std::vector<int>& labels);

}  // namespace cardiac
