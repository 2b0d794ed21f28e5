#pragma once

#include <string>

#include <cardiac/heart/beat_result.hpp>

namespace cardiac {

/// Pressure (mmHg) and volume (mL) of every ventricle against time (ms), one panel above the other, each
/// curve named at its end; ED and ES of every ventricle marked. Without a beat the course of the loading.
std::string time_curves_svg(const BeatResult& result);

}  // namespace cardiac
