#pragma once

#include <cardiac/run/beat.hpp>
#include <cardiac/training/tuned_model.hpp>

namespace cardiac {

/// What the tuned model of a scene is learned from, by the path of an untrained model: the loads of end
/// diastole and of instants that divide its path evenly (by pressure, volume and tension), others of half to
/// twice the filling and a fifth more or less afterload and tension, and the answers of every segment to
/// another tension and stiffness. Held out: loads between those, and every segment's tension (60–120 %) and
/// stiffness (70–150 %) at random, seeded by the round.
TuningPlan tuning_plan(const HeartPath& path, const Ventricle& untrained, const Scene& scene);

/// The same for a wall that is loaded at once, to pressures and a tension that rise together: the loads on
/// the way to them and somewhat beyond, and answers of every segment near its end.
TuningPlan tuning_plan(const TrainingLoad& load, const Ventricle& untrained);

}  // namespace cardiac
