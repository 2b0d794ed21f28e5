#pragma once

#include <string>
#include <vector>

#include <cardiac/bench/bench.hpp>

namespace cardiac {

/// bench.svg: displacement error against time of solution on logarithmic axes, one panel a scene, a colour
/// and a shape a method, hollow where the reduced model is integrated at every Gauss point; unknowns (full
/// order) or control nodes (reduced) written beside the marks. The reference, what did not converge, models
/// with settings of their own and scenes of fewer than four models are left out.
std::string bench_svg(const std::vector<SceneResult>& results);

}  // namespace cardiac
