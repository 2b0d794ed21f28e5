#pragma once

#include <string>
#include <vector>

#include <cardiac/core/beat_result.hpp>

namespace cardiac {

/// Bounds beyond which no ventricle of muscle goes.
inline constexpr double kMostEjection_percent = 95;
/// Of a ventricle that does not contract at all, whose volumes differ by the tolerance of the integration.
inline constexpr double kLeastEjection_percent = -0.1;
/// Above the highest pressure measured in a human artery (480 mmHg: MacDougall et al. 1985, J Appl Physiol
/// 58:785).
inline constexpr double kMostPressure_mmHg = 500;
/// Muscle keeps its volume within some per cent; a tenth at a point, or twice or half in the mean of a
/// segment, is a model that has come apart.
inline constexpr double kLeastPointVolume = 0.1, kLeastSegmentVolume = 0.5, kMostSegmentVolume = 2;
/// End-diastolic volume over the volume of the wall: 0.6 to 1 in health, 2 in dilated hearts.
inline constexpr double kMostCavityOverWall = 10;

/// What of a result is absurd, one text each with the number and its bound; empty where nothing is. Of any
/// result: a number that is none, a wall below a tenth of its volume at an integration point, a segment
/// beyond half or twice its volume, a cavity turned inside out. Of a beat besides: the ejection fraction, the
/// peak pressure and the cavities against the wall.
std::vector<std::string> absurdities(const BeatResult& result);

/// An absurd result is not a completed one: it gets a reason to have stopped or, where it is to be kept, a
/// warning.
void refuse_absurdities(BeatResult& result, bool keep);

}  // namespace cardiac
