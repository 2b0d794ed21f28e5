#pragma once

#include <cardiac/contraction/bestel_2001.hpp>
#include <cardiac/scene/scene.hpp>

namespace cardiac {

/// contraction.activation_duration_ms as given or, where it is not, 324 ms √(beat/800 ms): systole shortens
/// with the square root of the time between two beats. Source: Bazett 1920, for the QT interval.
double activation_duration_ms(const scene::Contraction& contraction, const scene::Time& time);

/// The contraction of a scene with the time counted from local activation.
BestelParameters bestel_parameters(const scene::Contraction& contraction, const scene::Time& time);

}  // namespace cardiac
