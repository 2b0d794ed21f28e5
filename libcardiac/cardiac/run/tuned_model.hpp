#pragma once

#include <cardiac/core/beat_result.hpp>
#include <cardiac/run/beat.hpp>
#include <cardiac/training/tuned_model.hpp>

namespace cardiac {

/// The tuned model of a scene: its own (Scene::tuned), that of the cache, or one that is learned now, by the
/// plan that the path of the fast preset gives (tuning_plan), and kept in the cache. Progress, rounds and the
/// wish to stop are those of the control. Throws as tune.
std::shared_ptr<const TunedModel> tuned_model(const std::shared_ptr<const Anatomy>& anatomy,
                                              const Scene& scene, const RunControl& control = {});

/// The errors of displacement that a tuned model estimates of itself at end diastole and end systole
/// (estimated_error), an instant at which there is no estimate left out. Empty without a path.
std::vector<EstimatedError> estimated_errors(const Ventricle& model, const Scene& scene,
                                             const HeartPath& path);

/// What there is to say of a path by a tuned model: an accuracy that its training did not reach, states
/// estimated to be further off than it was held to. Empty where all is well.
std::vector<std::string> tuned_warnings(const TunedModel& model, const Scene& scene,
                                        const std::vector<EstimatedError>& errors);

}  // namespace cardiac
