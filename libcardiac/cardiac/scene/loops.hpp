#pragma once

#include <memory>

#include <cardiac/circulation/two_sided_loop.hpp>
#include <cardiac/scene/scene.hpp>

/// The circulations that a scene's values belong to.
namespace cardiac {

LeftHeartLoop left_heart_loop(const scene::Circulation& circulation);
TwoSidedLoop two_sided_loop(const scene::Circulation& circulation);

/// The closed loop of two ventricles, or the open one of a left ventricle alone.
std::shared_ptr<const CirculationModel> circulation_model(bool two_ventricles,
                                                          const scene::Circulation& circulation);

}  // namespace cardiac
