#pragma once

#include <cardiac/bench/bench.hpp>

namespace cardiac {

inline constexpr auto kCubeBench = "cube";

/// The cube of the poly-affine paper between platens on which it cannot slip (see PlatenSolution): linear and
/// quadratic elements on several meshes, quadratic ones on the finest being the reference, and frames of 1 to
/// 33 zones with consistent weights, on one thread. Displacement errors are relative to the bulge, the
/// displacement beside homogeneous compression; the compliance is the change of thickness over that of the
/// reference; there is no cavity and no segment.
SceneResult run_cube_scene(const BenchContext& context);

}  // namespace cardiac
