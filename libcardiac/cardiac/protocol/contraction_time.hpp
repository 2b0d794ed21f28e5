#pragma once

#include <cardiac/contraction/bestel_2001.hpp>
#include <cardiac/protocol/protocol.hpp>

namespace cardiac {

/// Time between two beats, 60000/heart_rate_bpm in ms.
double beat_ms(const protocol::Time& time);

/// contraction.activation_duration_ms as given or, where it is not, 324 ms √(beat/800 ms): systole shortens
/// with the square root of the time between two beats. Source: Bazett 1920, for the QT interval.
double activation_duration_ms(const protocol::Contraction& contraction, const protocol::Time& time);

/// The contraction of a protocol with the time counted from local activation.
BestelParameters bestel_parameters(const protocol::Contraction& contraction, const protocol::Time& time);

}  // namespace cardiac
