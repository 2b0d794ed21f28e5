#pragma once

#include <string>

#include <cardiac/core/beat_result.hpp>

namespace cardiac {

/// Pressure (mmHg) against volume (mL) of every ventricle, coloured by phase, ED and ES marked; without
/// circulation the pressure–volume curve of the loading.
std::string pv_loop_svg(const BeatResult& result);

}  // namespace cardiac
