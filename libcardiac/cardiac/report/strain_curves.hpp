#pragma once

#include <string>

#include <cardiac/core/beat_result.hpp>

namespace cardiac {

/// Strain of the left ventricle's segments over the beat, percent against ms: a row for longitudinal,
/// circumferential and radial strain, a column for the basal, mid and apical level. Colour and dashes tell
/// the wall, the segment's number stands beside its curve at end systole, hairlines mark ED and ES; the
/// panels of a row have one scale.
std::string strain_curves_svg(const BeatResult& result);

/// The same of the right free wall, segments 18–29, at the scales of the left ventricle's.
std::string right_strain_curves_svg(const BeatResult& result);

}  // namespace cardiac
