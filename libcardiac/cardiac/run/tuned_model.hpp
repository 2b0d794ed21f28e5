#pragma once

#include <cardiac/run/beat.hpp>
#include <cardiac/training/tuned_model.hpp>

namespace cardiac {

/// The tuned model of a scene: its own (Scene::tuned), that of the cache, or one that is learned now, by the
/// plan that the path of the fast preset gives (tuning_plan), and kept in the cache. Progress, rounds and the
/// wish to stop are those of the control. Throws as tune.
std::shared_ptr<const TunedModel> tuned_model(const std::shared_ptr<const Anatomy>& anatomy,
                                              const Scene& scene, const RunControl& control = {});

/// What there is to say of a path by a tuned model: an accuracy that its training did not reach, states
/// outside of what it learned from. Empty where all is well.
std::vector<std::string> tuned_warnings(const TunedModel& model, const Scene& scene, const HeartPath& path);

}  // namespace cardiac
