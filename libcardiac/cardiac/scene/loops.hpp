#pragma once

#include <memory>

#include <cardiac/circulation/two_sided_loop.hpp>
#include <cardiac/scene/scene.hpp>

/// The circulations that a scene's values belong to.
namespace cardiac {

LeftHeartLoop left_heart_loop(const scene::Circulation& circulation);
TwoSidedLoop two_sided_loop(const scene::Circulation& circulation);

/// The network of a scene: one of its own, or the closed loop of 2022 with atria, whose times are stretched
/// to the beat and which stands for a right ventricle that the mesh has not; null where the windkessels are
/// used.
std::shared_ptr<const CirculationNetwork> network_of(bool two_ventricles, const Scene& scene);

/// The network of a scene, or the closed loop of two ventricles, or the open one of a left ventricle alone.
/// Throws InputError where a network has other cavities than the heart.
std::shared_ptr<const CirculationModel> circulation_model(bool two_ventricles, const Scene& scene);

/// When the first beat begins: what the cavities are filled to, kPa, and the states of the circulation behind
/// their volumes.
struct CirculationStart {
  polyaffine::Vector filling_kPa, states;
};
CirculationStart circulation_start(bool two_ventricles, const Scene& scene);

}  // namespace cardiac
