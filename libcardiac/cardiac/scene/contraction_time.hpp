#pragma once

#include <cardiac/contraction/bestel_2001.hpp>
#include <cardiac/contraction/sarcomere.hpp>
#include <cardiac/scene/scene.hpp>

namespace cardiac {

/// How much shorter the times behind the rates of a contraction are than human ones, contraction.time_factor
/// as given or, where it is not: 1 down to beats of 333 ms (180 a minute), below in proportion to the beat,
/// so that a heart of 700 a minute (a mouse) contracts and relaxes within it.
double time_factor(const scene::Contraction& contraction, const scene::Time& time);

/// contraction.activation_duration_ms as given or, where it is not, 324 ms √(beat/800 ms), below beats of 200
/// ms in proportion to the beat: systole shortens with the square root of the time between two beats. Source:
/// Bazett 1920, for the QT interval.
double activation_duration_ms(const scene::Contraction& contraction, const scene::Time& time);

/// Time constants of the rise and the decay of calcium (ms), as given or, where they are not, 20 and 50 ms at
/// 75 beats a minute, which follow the heart rate as activation_duration_ms does.
struct CalciumTimes {
  double rise_ms, decay_ms;
};
CalciumTimes calcium_times(const scene::Contraction& contraction, const scene::Time& time);

/// The contraction of a scene with the time counted from local activation.
BestelParameters bestel_parameters(const scene::Contraction& contraction, const scene::Time& time);

/// The sarcomeres of a scene whose contraction feels the fibre.
std::shared_ptr<const SarcomereModel> sarcomere_model(const scene::Contraction& contraction,
                                                      const scene::Time& time);

/// The scene with the isometric twitch of its sarcomeres (stretch 1) as a tension that is given: what stands
/// for them where a wall is loaded and nothing moves. Other scenes stay as they are.
Scene with_twitch(const Scene& scene);

}  // namespace cardiac
