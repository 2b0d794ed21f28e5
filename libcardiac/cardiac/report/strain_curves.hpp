#pragma once

#include <string>

#include <cardiac/heart/beat_result.hpp>

namespace cardiac {

/// Longitudinal, circumferential and radial strain of every segment over the beat in three panels, percent
/// against ms: colour tells the coronary territory (Cerqueira et al. 2002), dashes the level, hairlines mark
/// ED and ES.
std::string strain_curves_svg(const BeatResult& result);

}  // namespace cardiac
