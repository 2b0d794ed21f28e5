#pragma once

#include <string>

#include <cardiac/core/beat_result.hpp>

namespace cardiac {

/// Pressure (mmHg; that of the arteries dashed, where the result has the circulation) and volume (mL) of
/// every ventricle against time (ms), one panel above the other, each curve named at its end; ED and ES of
/// every ventricle marked. Without a systole the course of the loading.
std::string time_curves_svg(const BeatResult& result);

}  // namespace cardiac
